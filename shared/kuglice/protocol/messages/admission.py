"""How it stands with one session: told to nobody who cannot name it."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import Field

from kuglice.protocol.messages.envelope import U64, Message

__all__ = ["Admission"]


class Admission(Message):
    """Answers an ArrivalRequest.

    `number`: the one that the session plays under, None if it does not. `sequence`: the highest that was seen of that
    player, so that one that returns counts on from there. `refused`: why it will not be let in, None where that is
    open. `kept`: whether the name is kept for another session, whose link is cut.
    """

    kind: ClassVar[str] = "admission"
    max_bytes: ClassVar[int] = 4096
    max_reason: ClassVar[int] = 400
    """Characters."""

    number: int | None
    sequence: U64
    refused: Annotated[str, Field(max_length=max_reason)] | None
    kept: bool
