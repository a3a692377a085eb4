"""What happened lately: inputs and hashes per tick, and whole states now and then.

Written by the tick loop, read by the answering threads, hence the lock. Who joins wants the state of now, since every
tick by which it is older must be stepped through: such a one is made when it is asked for.
"""

from __future__ import annotations

import threading
from collections import deque
from typing import NamedTuple

from kuglice.protocol import StretchedTick

__all__ = ["History", "KeptSnapshot"]

FRESH_TICKS = 6
"""A state that is not older is told to whoever asks for that of now."""
BYTES_PER_TICK = 1 << 20
"""Of states that are made because they are asked for, at most: one of 56 bytes a ball and 10,000 balls takes 0.4 ms."""
FRESH_SECONDS = 0.25
"""How long one is waited for: ticks may be few, or stand still."""


class KeptSnapshot(NamedTuple):
    """state(tick), before inputs(tick)."""

    tick: int
    data: bytes


class History:
    """The last `span` ticks, and the snapshots within them that fit into `snapshot_bytes`."""

    def __init__(self, *, span: int, snapshot_bytes: int = 64 << 20) -> None:
        self.span = span
        self._snapshot_bytes = snapshot_bytes
        self._ticks: deque[StretchedTick] = deque(maxlen=span)
        self._snapshots: deque[KeptSnapshot] = deque()
        self._held_bytes = 0
        self._fresh: KeptSnapshot | None = None
        self._wanted = False
        self._lock = threading.Lock()
        self._made = threading.Condition(self._lock)

    def add_tick(self, entry: StretchedTick) -> None:
        """Keep the next tick."""
        with self._lock:
            self._ticks.append(entry)

    def add_snapshot(self, snapshot: KeptSnapshot) -> None:
        """Keep a state; those that no kept tick can continue, or that do not fit any more, are forgotten."""
        with self._made:
            self._snapshots.append(snapshot)
            self._held_bytes += len(snapshot.data)
            oldest = self._ticks[0].tick if self._ticks else 0
            while len(self._snapshots) > 1 and (
                self._held_bytes > self._snapshot_bytes or self._snapshots[0].tick < oldest
            ):
                self._held_bytes -= len(self._snapshots.popleft().data)
            self._made.notify_all()

    def add_fresh(self, snapshot: KeptSnapshot) -> None:
        """Tell a state of now to those who have asked for it."""
        with self._made:
            self._fresh = snapshot
            self._made.notify_all()

    def wants_fresh(self) -> bool:
        """Whether somebody has asked for the state of now since this was last called."""
        with self._lock:
            wanted, self._wanted = self._wanted, False
            return wanted

    def fresh_snapshot(self) -> KeptSnapshot | None:
        """A state of now, waited for; the newest that there is if none comes, None if there is none at all."""
        with self._made:
            if not self._is_fresh():
                self._wanted = True
                self._made.wait_for(self._is_fresh, FRESH_SECONDS)
            return self._newest()

    def ticks(self, first: int, end: int) -> list[StretchedTick]:
        """Those of the ticks first .. end - 1 that are still known."""
        with self._lock:
            if not self._ticks:
                return []
            oldest = self._ticks[0].tick
            begin = max(first - oldest, 0)
            stop = min(end - oldest, len(self._ticks))
            return [self._ticks[index] for index in range(begin, stop)]

    def recent(self, count: int) -> list[StretchedTick]:
        """The last `count` ticks, oldest first."""
        with self._lock:
            begin = max(len(self._ticks) - count, 0)
            return [self._ticks[index] for index in range(begin, len(self._ticks))]

    def snapshot(self, at: int) -> KeptSnapshot | None:
        """The newest kept snapshot whose tick is `at` or before; None if there is none any more."""
        with self._lock:
            return next((kept for kept in reversed(self._snapshots) if kept.tick <= at), None)

    def _newest(self) -> KeptSnapshot | None:
        known = [*([self._fresh] if self._fresh is not None else ()), *list(self._snapshots)[-1:]]
        return max(known, key=lambda one: one.tick, default=None)

    def _is_fresh(self) -> bool:
        newest = self._newest()
        now = self._ticks[-1].tick + 1 if self._ticks else 0
        return newest is not None and now - newest.tick <= max(
            FRESH_TICKS, len(newest.data) // BYTES_PER_TICK
        )
