"""What every message has: a kind, the world's epoch, and a bound on its size."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import BaseModel, ConfigDict, Field

__all__ = ["PROTOCOL_VERSION", "U64", "Message", "TickNumber"]

PROTOCOL_VERSION = 1
"""Raised by one when an old reader would misread a new message."""

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
