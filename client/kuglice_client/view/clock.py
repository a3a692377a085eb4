"""Which tick a view shows: the newest that could have been told by now."""

from __future__ import annotations

from collections import deque

__all__ = ["ViewClock"]

ARRIVALS = 64
STALL_SECONDS = 3.0


class ViewClock:
    """Seconds of any monotonic clock in, ticks out; `rate`: the server's ticks per second.

    The earliest of the last arrivals sets the pace, since delay only ever adds. A view acts on nothing, so it
    has no use for running ahead of the stream as a player does. Never goes back, and stops after a while
    without news.
    """

    def __init__(self, *, rate: float, tick: int, now: float) -> None:
        self._rate = rate
        self._origins: deque[float] = deque([now - tick / rate], maxlen=ARRIVALS)
        self._heard_at = now
        self._last = float(tick)

    def heard(self, tick: int, now: float) -> None:
        """Something of state(`tick`), which was new, came just now."""
        self._origins.append(now - tick / self._rate)
        self._heard_at = now

    def target(self, now: float) -> float:
        """The tick to show, fraction included."""
        until = min(now, self._heard_at + STALL_SECONDS)
        self._last = max(self._last, (until - min(self._origins)) * self._rate)
        return self._last
