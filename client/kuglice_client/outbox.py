"""Own inputs, from the moment of acting until the server says what became of them.

Every message carries all that is unacknowledged. It goes out with a new input and again in each of the next ticks, so
that one that is lost is made up for before its tick has come; after that only when an answer is overdue.
"""

from __future__ import annotations

from itertools import islice
from typing import NamedTuple

from kuglice.inputs import Input
from kuglice.protocol import MAX_INPUTS, Ack, ClientInputs, SentInput

__all__ = ["Outbox", "Outcome", "Pending"]

MAX_PENDING = 256
COPIES = 3
"""Messages in a row that carry a new input."""
REPORT_SECONDS = 0.1
"""After this long without anything else to say, the server is told what was heard of its stream."""


class Outcome(NamedTuple):
    """What became of an input: the tick in which it acted, or why it was refused."""

    given: Input
    tick: int | None
    refused: str | None


class Pending(NamedTuple):
    """An input, the tick it is meant for, and when and with how much lead (clock.py) it was made."""

    tick: int
    given: Input
    lead: float
    made: float

    def early(self, ack: Ack) -> int | None:
        """Ticks before its turn that it came (negative: late), as far as its outcome tells."""
        if ack.early is None and ack.tick is not None and ack.tick > self.tick:
            return self.tick - ack.tick
        return ack.early


class Outbox:
    """Sequence numbers go on from `sequence`, so that one who returns is not taken for an echo of itself.

    `tick_seconds`: from one copy of a message to the next. `resend_seconds`: after which an answer is overdue.
    """

    def __init__(
        self, *, epoch: int, number: int, sequence: int, tick_seconds: float, resend_seconds: float
    ) -> None:
        self.number = number
        self._epoch = epoch
        self._sequence = sequence
        self._tick_seconds = tick_seconds
        self._resend_seconds = resend_seconds
        self._pending: dict[int, Pending] = {}
        self._new = False
        self._copies = 0
        self._sent_at = 0.0
        self._reported = 0
        self.accepted = 0
        self.refused = 0
        self.late = 0

    @property
    def full(self) -> bool:
        """Whether too much is unacknowledged to add more: the link is down, or the server is."""
        return len(self._pending) >= MAX_PENDING

    def add(self, given: Input, tick: int, *, lead: float, made: float) -> Input:
        """Take an input meant for `tick`; returns it with this client's number and its sequence number."""
        self._sequence += 1
        mine: Input = given.model_copy(update={"client": self.number, "sequence": self._sequence})
        self._pending[self._sequence] = Pending(tick, mine, lead, made)
        self._new, self._copies = True, COPIES
        return mine

    def resolve(self, ack: Ack) -> Pending | None:
        """What an outcome was about, if it is news."""
        if ack.client != self.number or ack.sequence is None:
            return None
        pending = self._pending.pop(ack.sequence, None)
        if pending is None:
            return None
        if ack.tick is None:
            self.refused += 1
        else:
            self.accepted += 1
            early = pending.early(ack)
            self.late += early is not None and early < 0
        return pending

    def message(self, now: float, heard: int) -> ClientInputs | None:
        """What is to be sent now, if anything is; `heard` is the tick that we miss."""
        since = now - self._sent_at
        again = self._resend_seconds if not self._copies else self._tick_seconds
        acting = bool(self._pending) and (self._new or since >= again)
        reporting = heard > self._reported and since >= REPORT_SECONDS
        if not (acting or reporting):
            return None
        self._new = False
        self._copies = max(0, self._copies - 1)
        self._sent_at = now
        self._reported = heard
        sent = [SentInput(one.tick, one.given) for one in islice(self._pending.values(), MAX_INPUTS)]
        return ClientInputs(epoch=self._epoch, heard=heard, inputs=sent)
