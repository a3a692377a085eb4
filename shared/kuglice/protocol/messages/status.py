"""How a server is doing, and who plays."""

from __future__ import annotations

from typing import ClassVar

from pydantic import BaseModel, ConfigDict

from kuglice.protocol.messages.envelope import MAX_WHOLE_BYTES, U64, Message, TickNumber

__all__ = ["ClientStatus", "Status"]


class ClientStatus(BaseModel):
    """A client that is here; `number` orders its inputs in the step.

    `away`: its link is cut, and its return waited for. Its session is nobody's business but its own.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    number: int
    away: bool
    sequence: U64
    accepted: int
    late: int
    refused: int


class Status(Message):
    """`sequence` of a client is the highest one seen of it.

    `counters`: what came in, went out and went wrong, by names like those of the fields. What never was is missing.
    """

    kind: ClassVar[str] = "status"
    max_bytes: ClassVar[int] = MAX_WHOLE_BYTES

    world: str
    tick: TickNumber
    rate: float
    balls: int
    clients: dict[str, ClientStatus]
    counters: dict[str, int]
    seconds_lost: float
    worst_lateness: float
