"""When the ticks of a server end: when whoever runs it says so, or when it is closed, in whichever thread."""

from __future__ import annotations

import threading
import time

__all__ = ["Ending"]

LOOK_SECONDS = 0.05
"""Of two events only one can be waited for; the other is looked at so often."""


class Ending:
    """An event that is set as soon as one of two is."""

    def __init__(self, stop: threading.Event, closed: threading.Event) -> None:
        self._stop = stop
        self._closed = closed

    def is_set(self) -> bool:
        """Whether no other tick is to be made."""
        return self._stop.is_set() or self._closed.is_set()

    def wait(self, seconds: float) -> bool:
        """Until then, or for that long. Whether it is set."""
        until = time.monotonic() + seconds
        while not self.is_set() and (left := until - time.monotonic()) > 0:
            self._stop.wait(min(left, LOOK_SECONDS))
        return self.is_set()
