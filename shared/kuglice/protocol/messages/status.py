"""How a server is doing, and who plays."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import BaseModel, ConfigDict, Field

from kuglice.protocol.messages.envelope import U64, Message, TickNumber

__all__ = ["ClientStatus", "Status"]


class ClientStatus(BaseModel):
    """A client that is here (`number` orders its inputs in the step), or was refused, and then why."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    number: int
    sequence: U64
    accepted: int
    late: int
    refused: int
    refusal: Annotated[str, Field(max_length=400)] | None = None


class Status(Message):
    """`sequence` of a client is the highest one seen of it, so that one that returns counts on from there."""

    kind: ClassVar[str] = "status"
    max_bytes: ClassVar[int] = 4 << 20

    world: str
    tick: TickNumber
    rate: float
    balls: int
    clients: dict[str, ClientStatus]
    counters: dict[str, int]
    seconds_lost: float
    worst_lateness: float
