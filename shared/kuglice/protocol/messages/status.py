"""How a server is doing, and who plays."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import BaseModel, ConfigDict, Field

from kuglice.protocol.messages.envelope import U64, Message, TickNumber

__all__ = ["ClientStatus", "SessionRefusal", "Status"]


class ClientStatus(BaseModel):
    """A client that is here; `number` orders its inputs in the step.

    `session` is the one that plays it; `away`: its link is cut, and its return waited for.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    number: int
    session: str
    away: bool
    sequence: U64
    accepted: int
    late: int
    refused: int


class SessionRefusal(BaseModel):
    """A session that was not let in as the client `name`, and why."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    name: str
    session: str
    reason: Annotated[str, Field(max_length=400)]


class Status(Message):
    """`sequence` of a client is the highest one seen of it, so that one that returns counts on from there.

    `counters`: what came in, went out and went wrong, by names like those of the fields. What never was is missing.
    """

    kind: ClassVar[str] = "status"
    max_bytes: ClassVar[int] = 4 << 20

    world: str
    tick: TickNumber
    rate: float
    balls: int
    clients: dict[str, ClientStatus]
    refusals: list[SessionRefusal]
    counters: dict[str, int]
    seconds_lost: float
    worst_lateness: float
