"""The predicted world: ahead of the confirmed one, so that own inputs act at once.

Others' inputs are predicted too: what they hold, they go on holding. When the authoritative inputs of a tick
equal the predicted ones, the states do as well, and nothing is computed again; otherwise the confirmed world
is copied and run forward. That may take several turns: until it is done, what was drawn before stays on screen.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kuglice import World
from kuglice._core import INPUT_BYTES
from kuglice.blending import blend
from kuglice.budget import tick_budget
from kuglice.errors import StepError
from kuglice.inputs import Input, pack
from kuglice.protocol import StretchedTick

__all__ = ["Drawn", "Floats", "Ids", "Prediction"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]
Drawn = tuple[World, World]
"""Two states in a row; a frame is between them."""


class Prediction:
    """`world` is state(world.tick) as far as it can be known, `previous` the state one tick before it.

    At most `limit` ticks are predicted: what comes later waits.
    """

    def __init__(self, confirmed: World, *, limit: int) -> None:
        self.world = confirmed.clone()
        self.previous = confirmed.clone()
        self.limit = limit
        self._spare: Drawn | None = None
        self._shown: Drawn | None = None
        self._own: dict[int, list[Input]] = {}
        self._promised: dict[int, list[Input]] = {}
        self._used: dict[int, bytes] = {}
        self._wrong = False
        self._stuck = False
        self.rollbacks = 0
        self.deepest_rollback = 0
        self.ticks_rerun = 0
        self.held_back = 0

    def act(self, given: Input, tick: int) -> None:
        """An own input that is expected to act in `tick`, which is not predicted yet."""
        self._own.setdefault(tick, []).append(given)

    def settle(self, given: Input, planned: int, tick: int | None) -> None:
        """The server said in which tick an own input acts (None: in none, it was refused)."""
        if tick is not None:
            self._promised.setdefault(tick, []).append(given)
        if tick == planned:
            return
        if self._forget(given, planned) and tick is not None:
            self._own.setdefault(tick, []).append(given)
        self._wrong = (
            self._wrong or planned < self.world.tick or (tick is not None and tick < self.world.tick)
        )

    def confirm(self, entry: StretchedTick) -> None:
        """The authoritative inputs of a tick.

        Own ones that are neither in them nor answered yet wait for the next. One that was promised for this
        tick is not waited for: the server could not make the tick with it.
        """
        promised = self._promised.get(entry.tick, [])
        self._promised = {tick: given for tick, given in self._promised.items() if tick > entry.tick}
        mine = [given for given in self._own.pop(entry.tick, []) if given not in promised]
        told = {entry.inputs[at : at + INPUT_BYTES] for at in range(0, len(entry.inputs), INPUT_BYTES)}
        left = [given for given in mine if pack([given]) not in told]
        if left:
            self._own[entry.tick + 1] = left + self._own.get(entry.tick + 1, [])
        used = self._used.pop(entry.tick, None)
        if used != entry.inputs:
            self._wrong = True

    def reconcile(self, confirmed: World, in_time: Callable[[], bool] = lambda: True) -> bool:
        """Run forward again from the confirmed world if the prediction was wrong; whether that was so.

        As far as it is `in_time`, one tick at least; `step` does the rest.
        """
        wrong, reached = self._wrong, self.world.tick
        self._wrong = False
        self._stuck = self._stuck and reached >= confirmed.tick and not wrong
        if reached < confirmed.tick:
            # Nothing was predicted beyond this: no guess was wrong, the stream is just ahead of us.
            last = self._put_aside()
            self.previous.copy_from(last if reached == confirmed.tick - 1 else confirmed)
            self.world.copy_from(confirmed)
            self._used.clear()
            return False
        if not wrong:
            return False
        self._put_aside()
        self.world.copy_from(confirmed)
        self.previous.copy_from(confirmed)
        self._used.clear()
        until = min(reached, confirmed.tick + self.limit)
        self.rollbacks += 1
        self.deepest_rollback = max(self.deepest_rollback, until - confirmed.tick)
        while self.world.tick < until and not self._stuck:
            self.step()
            if not in_time():
                break
        return True

    def switched(self, confirmed: World) -> Drawn | None:
        """What was drawn until now, if it no longer is: the new prediction is as far, or the stream further."""
        if self._shown is None:
            return None
        behind = self.world.tick < self._shown[1].tick
        if behind and self._shown[1].tick >= confirmed.tick and self._may_go_on(confirmed):
            return None
        before = self._spare = self._shown
        self._shown = None
        return before

    @property
    def shown(self) -> Drawn:
        """The last two states to be drawn: of the prediction, or of the one before it while that is made again."""
        return self._shown or (self.previous, self.world)

    def drawn(self, alpha: float) -> tuple[Ids, Floats]:
        """Ids and positions (n, 2) to be drawn, `alpha` of the way from the last but one state to the last."""
        return self.blended(*self.shown, alpha)

    @staticmethod
    def blended(before: World, now: World, alpha: float) -> tuple[Ids, Floats]:
        """Ids of `now` and positions (n, 2), `alpha` of the way from one state to the next."""
        return now.id, blend(before.id, before.position, now.id, now.position, alpha)

    def distrust(self) -> None:
        """The confirmed world was replaced: run forward again from it, whatever was predicted."""
        self._wrong = True

    def may_step(self, confirmed: World) -> bool:
        """Whether one more tick may be predicted."""
        if self._may_go_on(confirmed):
            return True
        self.held_back += 1
        return False

    def step(self) -> None:
        """Predict one more tick."""
        now = self.world.tick
        inputs = pack(sorted(self._own.get(now, []), key=lambda one: one.sequence))
        self.previous.copy_from(self.world)
        try:
            self.world.step(inputs, budget=tick_budget(self.world))
        except StepError:
            # The server does not make this tick either; what it gives up so that it can, only it knows.
            self._stuck = True
            return
        self._used[now] = inputs
        if self._shown is not None and now < self._shown[1].tick:
            self.ticks_rerun += 1

    def _may_go_on(self, confirmed: World) -> bool:
        return not self._stuck and self.world.tick - confirmed.tick < self.limit

    def _put_aside(self) -> World:
        """Draw what there is until `switched`, and make the prediction elsewhere; the last state until now."""
        last = self.world
        if self._shown is None:
            spare = self._spare or (last.clone(), last.clone())
            self._shown, (self.previous, self.world) = (self.previous, last), spare
        return last

    def _forget(self, given: Input, planned: int) -> bool:
        # It may have been moved on from where it was planned, when that tick was confirmed without it.
        for tick in [planned, *(tick for tick in self._own if tick > planned)]:
            waiting = self._own.get(tick, [])
            if given in waiting:
                waiting.remove(given)
                return True
        return False
