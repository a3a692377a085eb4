"""What a view knows: the balls that it was told of, stepped on, and put right by whatever is told of an earlier tick.

Regions are told of ticks that are multiples of `every`. At each of those the world is kept as it came there. An update
goes into the log of its tick; if the view is past that tick, it goes back to the world that was kept, takes in all
that the log has, and steps forward again. So an update acts where it belongs, however late it came, and what the view
ends up with depends on what it was told, not on when.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field

from kuglice import BallStates, Model, Scene, World
from kuglice.errors import StepError
from kuglice_client.view.mosaic import Compare, Mosaic
from kuglice_client.view.told import Floats, Node, Told

__all__ = ["KnownWorld"]

KEPT_SECONDS = 3.0
AHEAD_SECONDS = 3.0

_Plays = tuple[int, int | None]
_Holds = tuple[int, str, float, float, float]


@dataclass
class _Log:
    """What was told of one tick."""

    regions: dict[int, Told] = field(default_factory=dict)
    fresh: set[int] = field(default_factory=set)
    holding: tuple[Sequence[_Plays], Sequence[_Holds]] | None = None


class KnownWorld:
    """`node_of`: nodes (n,) of places (n, 2).

    `compare`: called with ids (n,), told places (n, 2) and their distances to where these balls were thought to
    be, (n,) in radii, for all that is told for the first time.
    """

    def __init__(
        self,
        scene: Scene,
        model: Model,
        *,
        tick: int,
        every: int,
        node_of: Callable[[Floats], Node],
        compare: Compare,
    ) -> None:
        self._scene = scene
        self._model = model
        self._every = every
        self._kept_ticks = max(2, round(KEPT_SECONDS * scene.tick_rate / every)) * every
        self._ahead_ticks = max(2 * every, round(AHEAD_SECONDS * scene.tick_rate))
        self._node_of = node_of
        self._compare = compare
        self._followed: frozenset[int] = frozenset()
        self.too_old = 0
        self.jumps = 0
        self.rewinds = 0
        self.ticks_rerun = 0
        self.unusable = 0
        self._begin(tick)

    def _begin(self, tick: int) -> None:
        self._now = Mosaic.of(World.with_balls(self._scene, tick, BallStates.none(), self._model))
        self._kept: OrderedDict[int, Mosaic] = OrderedDict()
        self._log: dict[int, _Log] = {}
        self._redo: int | None = None
        if tick % self._every == 0:
            self._keep()

    @property
    def world(self) -> World:
        """The balls as they are thought to be now. Another object after a jump."""
        return self._now.world

    def follow(self, nodes: Collection[int]) -> None:
        """Keep what is in these nodes, and forget what was told of others."""
        self._followed = frozenset(nodes)
        self._now.keep_only(self._followed)

    def take(self, told: Told) -> bool:
        """Note an update for its tick. Whether it was new and not too old."""
        if told.node not in self._followed or not self._may_be_told(told.tick):
            return False
        log = self._log.setdefault(told.tick, _Log())
        if told.node in log.regions:
            return False
        log.regions[told.node] = told
        log.fresh.add(told.node)
        self._go_back_to(told.tick)
        return True

    def hold(
        self,
        tick: int,
        players: Sequence[_Plays],
        held: Sequence[_Holds],
    ) -> None:
        """Note who plays and what is held in state(tick)."""
        if self._may_be_told(tick):
            self._log.setdefault(tick, _Log()).holding = (players, held)
            self._go_back_to(tick)

    @property
    def unsettled(self) -> bool:
        """Whether something was told of the tick that the world is at, or of one before."""
        return self._redo is not None

    def settle(self) -> None:
        """Take in what was told of ticks up to that of the world, which stays where it is."""
        if self._redo is not None:
            tick, self._redo = self._redo, None
            self._guarded(lambda: self._restore(tick))

    def advance(self, tick: int) -> None:
        """Settle, then step to `tick`; never back."""
        self.settle()
        self._guarded(lambda: self._run(tick))
        self._forget_old()

    def at(self, tick: int) -> World | None:
        """The world of a tick that something was told of, with all of that taken in; None if it is not kept."""
        kept = self._kept.get(tick)
        if kept is None:
            return None
        then = kept.clone()
        then.keep_only(self._followed)
        self._take_in(then, compare=False)
        return then.world

    def told_of(self, tick: int) -> frozenset[int]:
        """The nodes that were told of at that tick."""
        log = self._log.get(tick)
        return frozenset() if log is None else frozenset(log.regions)

    def _may_be_told(self, tick: int) -> bool:
        if tick % self._every == 0 and tick > self.world.tick + self._ahead_ticks:
            self.jumps += 1
            self._begin(tick)
        if tick % self._every or tick < next(iter(self._kept), self.world.tick):
            self.too_old += 1
            return False
        return True

    def _go_back_to(self, tick: int) -> None:
        if tick <= self.world.tick:
            self._redo = tick if self._redo is None else min(self._redo, tick)

    def _guarded(self, run: Callable[[], None]) -> None:
        reached = self.world.tick
        try:
            run()
        except StepError:
            # What was told cannot be stepped: begin again with what is told next.
            self.unusable += 1
            self._begin(max(reached, self.world.tick))

    def _restore(self, tick: int) -> None:
        kept, reached = self._kept[tick], self.world.tick
        if tick < reached:
            self.rewinds += 1
            self.ticks_rerun += reached - tick
        self._now.copy_from(kept)
        self._now.keep_only(self._followed)
        self._take_in(self._now)
        self._run(reached)

    def _run(self, tick: int) -> None:
        while self.world.tick < tick:
            self.world.step()
            self._arrive()

    def _arrive(self) -> None:
        if self.world.tick % self._every == 0:
            self._keep()
            self._take_in(self._now)

    def _keep(self) -> None:
        tick = self.world.tick
        kept = self._kept.get(tick)
        if kept is None:
            self._kept[tick] = self._now.clone()
        else:
            kept.copy_from(self._now)

    def _forget_old(self) -> None:
        while self._kept and next(iter(self._kept)) < self.world.tick - self._kept_ticks:
            tick, _ = self._kept.popitem(last=False)
            for old in [other for other in self._log if other <= tick]:
                del self._log[old]

    def _take_in(self, mosaic: Mosaic, *, compare: bool = True) -> None:
        """All that was told of the tick that it is at."""
        log = self._log.get(mosaic.world.tick)
        if log is None:
            return
        if log.holding is not None:
            mosaic.world.hold(*log.holding)
        regions = [told for told in log.regions.values() if told.node in self._followed]
        if regions:
            mosaic.put_right(
                regions,
                log.fresh if compare else set(),
                followed=self._followed,
                node_of=self._node_of,
                compare=self._compare,
            )
            if compare:
                log.fresh.clear()
