"""Which tick a view shows: the newest that could have been told by now."""

from __future__ import annotations

from collections import deque

__all__ = ["ViewClock"]

ARRIVALS = 64
GAPS = 8
MOST_GAPS = 2
MOST_SECONDS = 0.25


class ViewClock:
    """Seconds of any monotonic clock in, ticks out; `rate`: the server's ticks per second.

    The earliest of the last arrivals sets the phase, since delay only ever adds. A view acts on nothing, so it
    has no use for running ahead of the stream as a player does. It goes no further beyond the newest tick than
    twice the ticks that lie between two pieces of news, or a quarter of a second: a server that cannot keep its
    rate is followed at the rate it has. Never goes back.
    """

    def __init__(self, *, rate: float, tick: int, now: float) -> None:
        self._rate = rate
        self._origins: deque[float] = deque([now - tick / rate], maxlen=ARRIVALS)
        self._gaps: deque[int] = deque([0], maxlen=GAPS)
        self._newest = tick
        self._last = float(tick)

    def heard(self, tick: int, now: float) -> None:
        """Something of state(`tick`), which was new, came just now."""
        self._origins.append(now - tick / self._rate)
        self._gaps.append(tick - self._newest)
        self._newest = tick

    def target(self, now: float) -> float:
        """The tick to show, fraction included."""
        beyond = max(MOST_GAPS * max(self._gaps), MOST_SECONDS * self._rate)
        wanted = min((now - min(self._origins)) * self._rate, self._newest + beyond)
        self._last = max(self._last, wanted)
        return self._last
