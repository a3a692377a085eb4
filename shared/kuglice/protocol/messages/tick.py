"""The authoritative stream: one message per tick, repeating the last few."""

from __future__ import annotations

from typing import Annotated, ClassVar, NamedTuple

from pydantic import Field

from kuglice.protocol.messages.envelope import U64, TickNumber
from kuglice.protocol.messages.stretch import Stretch

__all__ = ["Ack", "Tick"]

Reason = Annotated[str, Field(max_length=400)]


class Ack(NamedTuple):
    """What became of an input.

    `tick` is the one it acts in, None if it was refused, and then `refused` says why. `early` is how many
    ticks before its turn it came (negative: too late for the tick it asked for). `sequence` is None for a
    message that could not be read at all.
    """

    client: int
    sequence: U64 | None
    tick: TickNumber | None
    early: int
    refused: Reason | None


class Tick(Stretch):
    """Tick `end - 1` and a few before it, so that a lost message heals with the next one."""

    kind: ClassVar[str] = "tick"
    max_bytes: ClassVar[int] = 1 << 20

    acks: Annotated[list[Ack], Field(max_length=4096, strict=False)]
