"""How often what has happened, counted by several threads: the tick, whoever tells regions beside it."""

from __future__ import annotations

import threading

__all__ = ["Counters"]


class Counters:
    """Numbers by name, 0 where nothing was counted. Safe from any thread: no count is lost."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._counts: dict[str, int] = {}

    def add(self, name: str, count: int = 1) -> None:
        """That many more."""
        with self._lock:
            self._counts[name] = self._counts.get(name, 0) + count

    def __getitem__(self, name: str) -> int:
        """So many so far."""
        with self._lock:
            return self._counts.get(name, 0)

    def all(self) -> dict[str, int]:
        """All that were ever counted, as they are at one moment."""
        with self._lock:
            return dict(self._counts)
