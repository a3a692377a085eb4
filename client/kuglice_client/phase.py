"""Where the stream of ticks is at a time, from when its last messages came: delay only ever adds.

The earliest of them says where the stream began, as long as the server keeps its rate. One that is too slow for it
falls back all the time, by `drift` seconds per second; so do its earliest messages.
"""

from __future__ import annotations

import itertools
from collections import deque
from typing import NamedTuple

__all__ = ["Phase"]

ARRIVALS = 256
PARTS = 4
"""Of the last arrivals, in order of time: where a server falls back, the earliest of each comes later and later."""
LEAST_ARRIVALS = 6 * PARTS
RISE_SECONDS = 0.01
"""From one part to the next. What is less, delays that vary may feign."""


class _Arrival(NamedTuple):
    """`origin`: when tick 0 would have been told, had all come like this one."""

    at: float
    origin: float


class Phase:
    """`rate`: ticks per second of a server that is not too slow. It begins with `tick` at `now`, in seconds."""

    def __init__(self, *, rate: float, tick: float, now: float) -> None:
        self._rate = rate
        self._arrivals: deque[_Arrival] = deque([_Arrival(now, now - tick / rate)], maxlen=ARRIVALS)
        self._earliest = self._arrivals[0].origin
        self.drift = 0.0
        self.known = False
        """Whether the stream has had the time to show how much it varies."""

    @property
    def rate(self) -> float:
        """Ticks per second that the server makes."""
        return self._rate * (1 - self.drift)

    def tick(self, now: float) -> float:
        """What the stream would have told by `now`, had it no delay that varies; fraction included."""
        return (now - self._earliest - self.drift * now) * self._rate

    def behind(self, next_tick: int, now: float) -> float:
        """Seconds by which a message that tells everything before `next_tick` is later than the earliest."""
        return now - next_tick / self._rate - self._earliest - self.drift * now

    def late(self, quantile: float) -> float:
        """Seconds after the earliest possible moment by which that share of the messages came."""
        origins = sorted(self._levelled())
        return origins[int(quantile * (len(origins) - 1))] - origins[0]

    def heard(self, next_tick: int, now: float) -> None:
        """The stream told everything before `next_tick`, just now."""
        self._arrivals.append(_Arrival(now, now - next_tick / self._rate))
        self.known = self.known or len(self._arrivals) == ARRIVALS
        drift = self._least_rise()
        if self.drift and not drift:
            # What came while the server fell back would have come later by now.
            self._arrivals = deque(list(self._arrivals)[-len(self._arrivals) // PARTS :], maxlen=ARRIVALS)
        self.drift = drift
        self._earliest = min(self._levelled())

    def forget(self) -> None:
        """What came until now says nothing about what comes: the next message counts alone."""
        self._arrivals.clear()
        self.drift, self.known = 0.0, False

    def forget_later(self, next_tick: int, now: float, *, seconds: float) -> bool:
        """Forget messages that came later than this one by more. Whether there were any."""
        latest = now - next_tick / self._rate + seconds
        kept = [one for one in self._arrivals if one.origin <= latest]
        forgotten = len(kept) < len(self._arrivals)
        if forgotten:
            self._arrivals, self.known = deque(kept, maxlen=ARRIVALS), False
        return forgotten

    def _levelled(self) -> list[float]:
        """Origins as they would be if the server did not fall back."""
        return [origin - self.drift * at for at, origin in self._arrivals]

    def _least_rise(self) -> float:
        """Seconds per second, the least from one part to the next: a stall is one step. 0 if too small to tell."""
        if len(self._arrivals) < LEAST_ARRIVALS:
            return 0.0
        size = len(self._arrivals) // PARTS
        recent = list(self._arrivals)[-PARTS * size :]
        firsts = [min(recent[part * size : (part + 1) * size], key=_origin) for part in range(PARTS)]
        pairs = list(itertools.pairwise(firsts))
        # Those that have waited for us come in one moment, and in any order.
        if any(later.origin - one.origin < RISE_SECONDS or later.at <= one.at for one, later in pairs):
            return 0.0
        return min((later.origin - one.origin) / (later.at - one.at) for one, later in pairs)


def _origin(arrival: _Arrival) -> float:
    return arrival.origin
