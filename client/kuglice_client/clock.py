"""Which tick it is: where the stream is now, and how far ahead of it this client runs.

The stream's phase is the earliest arrival seen lately (delay only ever adds), let slip slowly so that a
server that slowed down is followed. The lead follows the server's own report of how early each input came.
Neither jumps: the client's rate stays within 2 % of the server's, except after a long stall.
"""

from __future__ import annotations

from collections import deque

__all__ = ["Clock"]

SLIP = 0.02
STALL_SECONDS = 0.5
EARLY_TICKS = 1
REPORTS = 32
ARRIVALS = 256
TRIPS = 8
JITTER_QUANTILE = 0.95


class Clock:
    """Seconds of any monotonic clock in, ticks out. `rate`: the server's ticks per second."""

    def __init__(self, *, rate: float, tick: int, now: float, round_trip: float) -> None:
        self._rate = rate
        self._origin = now - tick / rate
        self._heard_at = now
        self._lead = 2.0 + round_trip * rate
        self._wanted_lead = self._lead
        self._slewed_at = now
        self._trips: deque[float] = deque([round_trip], maxlen=TRIPS)
        self._late: deque[float] = deque(maxlen=ARRIVALS)
        self._early: deque[int] = deque(maxlen=REPORTS)
        self._last = 0.0
        self.snaps = 0

    @property
    def lead(self) -> float:
        """Ticks that the client runs ahead of the stream as it hears it."""
        return self._lead

    @property
    def round_trip(self) -> float:
        """Seconds; the shortest of the last queries, since whatever waits only adds."""
        return min(self._trips)

    @property
    def jitter(self) -> float:
        """Seconds after the earliest possible moment by which 95 % of the tick messages came."""
        late = sorted(self._late)
        return late[int(JITTER_QUANTILE * (len(late) - 1))] if late else 0.0

    def answered(self, round_trip: float) -> None:
        """A query took that many seconds."""
        self._trips.append(round_trip)

    def heard(self, next_tick: int, now: float) -> None:
        """The stream told everything before `next_tick`, just now."""
        origin = now - next_tick / self._rate
        late = origin - self._origin
        if late > STALL_SECONDS:
            self._origin = origin
            self.snaps += 1
        elif late < 0:
            self._origin = origin
        else:
            self._origin += min(late, SLIP * (now - self._heard_at))
            self._late.append(late)
        self._heard_at = now

    def reported(self, early: int) -> None:
        """The server said how many ticks before its turn an input came (negative: late)."""
        self._early.append(early)
        worst = min(self._early)
        if early < EARLY_TICKS:
            self._wanted_lead = self._lead + (EARLY_TICKS - early)
            self._early.clear()
        elif len(self._early) == REPORTS and worst > EARLY_TICKS:
            self._wanted_lead = self._lead - (worst - EARLY_TICKS) / 2
            self._early.clear()

    def target(self, now: float) -> float:
        """The tick that the predicted world should be at, fraction included; never less than before."""
        change = SLIP * self._rate * (now - self._slewed_at)
        self._slewed_at = now
        self._lead += max(-change, min(change, self._wanted_lead - self._lead))
        # Without news the clock does not run away: the stream may have stopped.
        heard = min(now, self._heard_at + STALL_SECONDS)
        target = (heard - self._origin) * self._rate + self._lead
        self._last = max(self._last, target)
        return self._last
