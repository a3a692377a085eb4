"""What a client wants to do. Who it is comes from the key it puts on, never from here."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field

from kuglice.protocol.messages.envelope import U64, Message, TickNumber

__all__ = ["MAX_INPUTS", "ClientInputs", "SentInput"]

MAX_INPUTS = 64


class SentInput(BaseModel):
    """One input, meant for `tick`.

    `act` is the input as kuglice.inputs.to_message has it, without its client.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    sequence: U64
    tick: TickNumber
    act: dict[str, Any]


class ClientInputs(Message):
    """Everything that the client has not seen acknowledged yet, oldest first."""

    kind: ClassVar[str] = "inputs"
    max_bytes: ClassVar[int] = 16 << 10

    inputs: Annotated[list[SentInput], Field(max_length=MAX_INPUTS)]
