"""The confirmed world: the tick stream, put in order and stepped through; never a guess."""

from __future__ import annotations

import logging
from collections import OrderedDict
from collections.abc import Iterator
from typing import NamedTuple

from kuglice import World
from kuglice.errors import InputError, StepError
from kuglice.protocol import Stretch, StretchedTick

__all__ = ["Confirmed", "Follower"]

log = logging.getLogger(__name__)

BUFFERED_TICKS = 36_000
KEPT_TICKS = 1_200


class Confirmed(NamedTuple):
    """A tick of the stream that was stepped, and the hash of state(tick + 1) here, if the stream tells one."""

    entry: StretchedTick
    state_hash: int | None


class Follower:
    """`world` is the server's state(world.tick), unless something broke; reconcile.py finds out."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._buffer: dict[int, StretchedTick] = {}
        self._kept: OrderedDict[int, StretchedTick] = OrderedDict()
        self._newest = -1
        self.missed_messages = 0
        self.healed_by_repeats = 0
        self.healed_by_history = 0
        self.unusable = 0

    def take(self, stretch: Stretch, *, from_history: bool = False) -> None:
        """Buffer what is not stepped yet. Any order, any overlap."""
        newest = stretch.end - 1
        if not from_history:
            if 0 <= self._newest < newest - 1:
                self.missed_messages += newest - 1 - self._newest
            told_before, self._newest = self._newest, max(self._newest, newest)
        for entry in stretch.ticks():
            if entry.tick < self.world.tick or len(self._buffer) >= BUFFERED_TICKS:
                continue
            known = self._buffer.get(entry.tick)
            if known is not None:
                # A repeat tells no hash; should the message that does come after it, nothing else is new in it.
                if known.state_hash is None and known.inputs == entry.inputs:
                    self._buffer[entry.tick] = entry
                continue
            self._buffer[entry.tick] = entry
            if from_history:
                self.healed_by_history += 1
            elif told_before >= 0 and entry.tick != newest:
                self.healed_by_repeats += 1

    @property
    def gap(self) -> tuple[int, int] | None:
        """Ticks [first, end) that neither stream nor repeats brought, if later ones are here."""
        if not self._buffer or self.world.tick in self._buffer:
            return None
        return self.world.tick, min(self._buffer)

    @property
    def holes_end(self) -> int:
        """Behind the last tick that is missing before one that is here; the first of them begins the `gap`."""
        end = max(self._buffer, default=self.world.tick)
        while end - 1 in self._buffer:
            end -= 1
        return max(end, self.world.tick)

    @property
    def behind(self) -> int:
        """Ticks that the stream has told and the world has not done."""
        return max(0, self._newest + 1 - self.world.tick)

    def advance(self) -> Iterator[Confirmed]:
        """Step through what is buffered, as far as it is complete; breaking off loses nothing."""
        while True:
            entry = self._buffer.pop(self.world.tick, None)
            if entry is None:
                return
            try:
                self.world.step(entry.inputs)
            except (InputError, StepError) as error:
                # A damaged tick leaves a gap, which the server's history fills.
                self.unusable += 1
                log.warning("tick %d: %s", entry.tick, error)
                return
            self._kept[entry.tick] = entry
            while len(self._kept) > KEPT_TICKS:
                self._kept.popitem(last=False)
            # Hashing costs a pass over the balls: no use where there is nothing to compare with.
            yield Confirmed(entry, None if entry.state_hash is None else self.world.state_hash)

    def rerun(self, world: World, until: int) -> bool:
        """Bring an older state up to state `until` by the ticks kept since; whether they reach that far."""
        while world.tick < until:
            entry = self._kept.get(world.tick)
            if entry is None:
                return False
            world.step(entry.inputs)
        return True

    def replace(self, world: World) -> None:
        """Go on from another state: an older one is brought up to where this was, by the ticks kept since."""
        reached = self.world.tick
        for tick in range(world.tick, reached):
            if tick not in self._kept:
                break
            self._buffer.setdefault(tick, self._kept[tick])
        self._buffer = {tick: entry for tick, entry in self._buffer.items() if tick >= world.tick}
        self.world = world
