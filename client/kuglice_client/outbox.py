"""Own inputs, from the moment of acting until the server says what became of them."""

from __future__ import annotations

from typing import NamedTuple

from kuglice.inputs import Input, to_message
from kuglice.protocol import MAX_INPUTS, Ack, ClientInputs, SentInput

__all__ = ["Outbox", "Pending"]

MAX_PENDING = 256


class Pending(NamedTuple):
    """An input and the tick it is meant for."""

    tick: int
    given: Input


class Outbox:
    """Sequence numbers go on from `sequence`, so that one who returns is not taken for an echo of itself."""

    def __init__(self, *, epoch: int, number: int, sequence: int, resend_seconds: float) -> None:
        self.number = number
        self._epoch = epoch
        self._sequence = sequence
        self._resend_seconds = resend_seconds
        self._pending: dict[int, Pending] = {}
        self._unsent = False
        self._sent_at = 0.0
        self.accepted = 0
        self.refused = 0
        self.late = 0

    @property
    def full(self) -> bool:
        """Whether too much is unacknowledged to add more: the link is down, or the server is."""
        return len(self._pending) >= MAX_PENDING

    def add(self, given: Input, tick: int) -> Input:
        """Take an input meant for `tick`; returns it with this client's number and its sequence number."""
        self._sequence += 1
        mine: Input = given.model_copy(update={"client": self.number, "sequence": self._sequence})
        self._pending[self._sequence] = Pending(tick, mine)
        self._unsent = True
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
            self.late += ack.early < 0
        return pending

    def message(self, now: float) -> ClientInputs | None:
        """Everything unacknowledged, if some of it is new or was sent long enough ago; None otherwise."""
        if not self._pending or not (self._unsent or now - self._sent_at >= self._resend_seconds):
            return None
        self._unsent = False
        self._sent_at = now
        sent = []
        for sequence, pending in list(self._pending.items())[:MAX_INPUTS]:
            act = to_message(pending.given)
            del act["client"], act["sequence"]
            sent.append(SentInput(sequence=sequence, tick=pending.tick, act=act))
        return ClientInputs(epoch=self._epoch, inputs=sent)
