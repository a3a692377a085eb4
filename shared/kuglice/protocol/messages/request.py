"""What is asked on the keys `history` and `status`.

The epoch is the one the asker lives in: a restarted server refuses it.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator

from kuglice.protocol.messages.envelope import Message, TickNumber

__all__ = ["ANY_EPOCH", "ArrivalRequest", "SnapshotRequest", "TickRange"]

ANY_EPOCH = 0


class TickRange(Message):
    """Asks for the ticks first .. end - 1."""

    kind: ClassVar[str] = "ticks?"
    max_bytes: ClassVar[int] = 512

    first: TickNumber
    end: TickNumber

    @model_validator(mode="after")
    def _not_empty(self) -> Self:
        if self.end <= self.first:
            raise ValueError(f"end {self.end}: must be above first {self.first}")
        return self


class SnapshotRequest(Message):
    """Asks for the newest snapshot whose tick is `at` or before (None: one of now).

    One who joins asks before it knows the epoch: ANY_EPOCH is answered by whichever run this is.
    """

    kind: ClassVar[str] = "snapshot?"
    max_bytes: ClassVar[int] = 512

    at: TickNumber | None


class ArrivalRequest(Message):
    """Asks for an Admission, once it is clear whether this `session` plays `name`: it has just shown itself.

    The epoch is not known yet: ANY_EPOCH.
    """

    kind: ClassVar[str] = "arrival?"
    max_bytes: ClassVar[int] = 1024

    name: Annotated[str, Field(max_length=256)]
    session: Annotated[str, Field(max_length=256)]
