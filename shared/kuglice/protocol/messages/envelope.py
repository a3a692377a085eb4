"""What every message has: a kind, the world's epoch, and a bound on its size."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, Field

__all__ = ["MAX_WHOLE_BYTES", "PROTOCOL_VERSION", "U64", "CompactMessage", "Message", "TickNumber"]

PROTOCOL_VERSION = 5
"""Raised by one when an old reader would misread a new message."""

MAX_WHOLE_BYTES = 1 << 20
"""Of a message that goes over the wire as it is, and not in parts."""

U64 = Annotated[int, Field(ge=0, lt=2**64)]
TickNumber = Annotated[int, Field(ge=0, lt=2**62)]


class Message(BaseModel):
    """A map on the wire.

    `epoch` is the run of the server that it belongs to: another epoch, another history.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    kind: ClassVar[str]
    max_bytes: ClassVar[int]

    epoch: U64

    def to_body(self) -> dict[str, Any]:
        """What the map holds besides the version."""
        return {"kind": self.kind, **self.model_dump()}

    @classmethod
    def from_body(cls, body: dict[str, Any]) -> Self:
        """What to_body made, without `kind`. Raises ValidationError or ProtocolError."""
        return cls.model_validate(body)


class CompactMessage(Message):
    """One that goes out at every tick: a `letter` that says the kind, the protocol's version in a byte, the fields.

    A map and words for its keys would cost more than all that most of these messages have to say.
    """

    letter: ClassVar[bytes]

    def to_bytes(self) -> bytes:
        """All of it."""
        out = bytearray((*self.letter, PROTOCOL_VERSION))
        self.write(out)
        return bytes(out)

    def write(self, out: bytearray) -> None:
        """Append the fields."""
        raise NotImplementedError

    @classmethod
    def read(cls, data: bytes) -> Self:
        """What `write` wrote. Raises ValidationError or ProtocolError."""
        raise NotImplementedError
