"""Which tick it is: where the stream is now, and how far ahead of it this client runs.

Where the stream is, its phase says. The lead over it is what the server's own reports of how early each input came ask
for: with each input goes the lead that it was made with, so that a report says what lead would have been just enough,
however much the clock has moved since. The worst of the last reports counts. Until there are enough of them, round
trip and jitter of the stream stand in: for who acts seldom they always do.

What comes of it moves at 0.98 to 1.02 times the server's rate, or slower where the server is too slow for its rate: at
0.98 times what it makes, while one that keeps its rate again is followed at once. It jumps only on joining and after a
long stall, and within the two seconds after that: what is measured then may have been held up by a lost segment, or by
a state that fills the link, and a lead that is too long by a second would take a minute to go.
"""

from __future__ import annotations

from collections import deque

from kuglice_client.phase import Phase

__all__ = ["Clock"]

SLEW = 0.02
STALL_SECONDS = 0.5
SETTLING_SECONDS = 2.0
FALL_SECONDS = 0.2
"""By which the lead must be too long to be given up at once while settling: the picture stands still meanwhile."""
QUEUED_SECONDS = 0.05
"""While settling, messages that were later than the next one by more had been queueing; that is no jitter."""
SAFETY_TICKS = 0.5
REPEAT_TICKS = 1.0
"""From one copy of an input to the next: a lost message must be made up for in time."""
RETRANSMISSION_TRIPS = 1.25
"""Round trips by which a lost segment comes later: RFC 8985 waits for a quarter of one before it sends it again."""
FIRST_JITTER_TRIPS = 0.5
"""Round trips that one may vary by, as long as nothing else is known: as RFC 6298 has it."""
REPORTS = 256
REPORT_SECONDS = 60.0
TRIPS = 8
JITTER_QUANTILE = 0.95
WORST_QUANTILE = 0.99


class Clock:
    """Seconds of any monotonic clock in, ticks out. `rate`: the server's ticks per second.

    `input_delay`: ticks between an own input and its effect, by which less lead is needed. `in_order`: whether a
    message that is lost holds up those after it, as over tcp alone.
    """

    def __init__(
        self,
        *,
        rate: float,
        tick: int,
        now: float,
        round_trip: float,
        input_delay: int = 0,
        in_order: bool = False,
    ) -> None:
        self._rate = rate
        self._in_order = in_order
        self._input_delay = input_delay
        self._heard_at = now
        self._trips: deque[float] = deque([round_trip], maxlen=TRIPS)
        self._phase = Phase(rate=rate, tick=tick, now=now)
        self._needed: deque[tuple[float, float]] = deque(maxlen=REPORTS)
        self._resumed_at = self._counted_since = now
        self._moved_to = now
        self._at: float | None = None
        self._last = 0.0
        self._jump = True
        self._wanted_lead = self._guessed_lead()
        self.pace = 1.0
        """Ticks per tick of the server, when last asked."""
        self.snaps = 0

    @property
    def lead(self) -> float:
        """Ticks that the client runs ahead of the stream as it hears it."""
        return self._wanted_lead if self._at is None else self._last - self._phase.tick(self._moved_to)

    @property
    def wanted_lead(self) -> float:
        """Ticks that it should be ahead; `lead` gets there by and by."""
        return self._wanted_lead

    @property
    def round_trip(self) -> float:
        """Seconds; the shortest of the last queries, since whatever waits only adds."""
        return min(self._trips)

    @property
    def jitter(self) -> float:
        """Seconds after the earliest possible moment by which 95 % of the tick messages came."""
        return self._phase.late(JITTER_QUANTILE)

    def answered(self, round_trip: float) -> None:
        """A query took that many seconds."""
        self._trips.append(round_trip)
        self._want(self._heard_at)

    def relinked(self, now: float, *, in_order: bool) -> None:
        """The link is another one now: what inputs asked for on the last says nothing of it."""
        self._in_order = in_order
        self._count_reports_from(now)

    def heard(self, next_tick: int, now: float) -> None:
        """The stream told everything before `next_tick`, just now."""
        behind = self._phase.behind(next_tick, now)
        silent = now - self._heard_at > STALL_SECONDS
        if silent or behind > STALL_SECONDS:
            self.snaps += not self._jump
            self._jump = True
            self._count_reports_from(now)
        # What has waited, for us to join or for the link to return, says nothing about jitter.
        if self._jump:
            self._phase.forget()
        elif (
            self._settling(now)
            and behind < 0.0
            and self._phase.forget_later(next_tick, now, seconds=QUEUED_SECONDS)
        ):
            # Nor does the lead over a stream that was late by so much say what lead is needed.
            self._count_reports_from(now)
        self._phase.heard(next_tick, now)
        self._heard_at = now
        self._want(now)

    def reported(self, early: int, *, lead: float, made: float) -> None:
        """The server said how many ticks before its turn an input came (negative: late).

        It was `made` at that time, in seconds, with that `lead`.
        """
        if made < self._counted_since or early < -STALL_SECONDS * self._rate:
            # Held up by a stall, or by a link that is gone: no lead would have been enough, nor is one needed now.
            return
        self._needed.append((self._heard_at, lead - early))
        self._want(self._heard_at)

    def target(self, now: float) -> float:
        """The tick that the predicted world should be at, fraction included; never less than before."""
        # Without news the clock does not run away: the stream may have stopped.
        until = max(self._moved_to, min(now, self._heard_at + STALL_SECONDS))
        passed = (until - self._moved_to) * self._rate
        made = (until - self._moved_to) * self._phase.rate
        self._moved_to = until
        wanted = self._phase.tick(until) + self._wanted_lead
        if self._at is None or self._jump:
            self._at, self._jump, self._resumed_at = wanted, False, until
        else:
            slowest, fastest = self._at + (1 - SLEW) * made, self._at + (1 + SLEW) * passed
            if self._settling(until):
                fastest = max(wanted, fastest)
                slowest = wanted if self._at - wanted > FALL_SECONDS * self._rate else slowest
            at = max(slowest, min(fastest, wanted))
            self.pace = (at - self._at) / passed if passed else self.pace
            self._at = at
        self._last = max(self._last, self._at)
        return self._last

    def _count_reports_from(self, now: float) -> None:
        self._counted_since = now
        self._needed.clear()

    def _settling(self, now: float) -> bool:
        return now - self._resumed_at < SETTLING_SECONDS

    def _want(self, now: float) -> None:
        while self._needed and now - self._needed[0][0] > REPORT_SECONDS:
            self._needed.popleft()
        needed = max((need for _, need in self._needed), default=0.0) + SAFETY_TICKS
        full = len(self._needed) == REPORTS
        self._wanted_lead = max(0.0, needed if full else max(needed, self._guessed_lead()))

    def _guessed_lead(self) -> float:
        jitter = self._phase.late(WORST_QUANTILE)
        if not self._phase.known:
            # Until the stream has had the time to show how much it varies, and how long losses hold it up.
            trips = RETRANSMISSION_TRIPS if self._in_order else FIRST_JITTER_TRIPS
            jitter = max(jitter, trips * self.round_trip)
        return SAFETY_TICKS + REPEAT_TICKS + (self.round_trip + jitter) * self._rate - self._input_delay
