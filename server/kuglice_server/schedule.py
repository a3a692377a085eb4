"""When each tick is due, on an absolute schedule: lateness does not add up."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from kuglice_server.ending import Ending

__all__ = ["Schedule"]


class Schedule:
    """Ticks at `rate` per second of `clock` (seconds, monotonic).

    A tick that runs late is caught up by the next ones, which then do not wait. More than `patience` seconds
    behind, the rest is given up instead (a server that cannot keep up must not run ever further behind its
    schedule): `seconds_lost` says how much, and the owner reports it.
    """

    def __init__(
        self, rate: float, *, patience: float = 0.25, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.rate = rate
        self._patience = patience
        self._clock = clock
        self._begin = clock()
        self._ticks = 0
        self.late_ticks = 0
        self.seconds_lost = 0.0
        self.worst_lateness = 0.0

    @property
    def due(self) -> float:
        """Clock time of the next tick."""
        return self._begin + self._ticks / self.rate

    def wait(self, ending: Ending | threading.Event) -> float:
        """Sleep until the next tick is due, or until `ending`. Returns how late it is already, in seconds."""
        ahead = self.due - self._clock()
        if ahead > 0:
            ending.wait(ahead)
        lateness = max(0.0, self._clock() - self.due)
        self.worst_lateness = max(self.worst_lateness, lateness)
        if lateness > 1 / self.rate:
            self.late_ticks += 1
        if lateness > self._patience:
            self._begin += lateness
            self.seconds_lost += lateness
        self._ticks += 1
        return lateness
