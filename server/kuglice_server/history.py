"""What happened lately: inputs and hashes per tick, and whole states now and then.

Written by the tick loop, read by the answering threads, hence the lock.
"""

from __future__ import annotations

import threading
from collections import deque
from typing import NamedTuple

from kuglice.protocol import StretchedTick

__all__ = ["History", "KeptSnapshot"]


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
        self._lock = threading.Lock()

    def add_tick(self, entry: StretchedTick) -> None:
        """Keep the next tick."""
        with self._lock:
            self._ticks.append(entry)

    def add_snapshot(self, snapshot: KeptSnapshot) -> None:
        """Keep a state; those that no kept tick can continue, or that do not fit any more, are forgotten."""
        with self._lock:
            self._snapshots.append(snapshot)
            self._held_bytes += len(snapshot.data)
            oldest = self._ticks[0].tick if self._ticks else 0
            while len(self._snapshots) > 1 and (
                self._held_bytes > self._snapshot_bytes or self._snapshots[0].tick < oldest
            ):
                self._held_bytes -= len(self._snapshots.popleft().data)

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

    def snapshot(self, at: int | None) -> KeptSnapshot | None:
        """The newest snapshot whose tick is `at` or before; None if there is none any more."""
        with self._lock:
            for kept in reversed(self._snapshots):
                if at is None or kept.tick <= at:
                    return kept
            return None
