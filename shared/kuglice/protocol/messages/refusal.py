"""Why a query was not answered."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import Field

from kuglice.protocol.messages.envelope import Message

__all__ = ["Refusal"]


class Refusal(Message):
    """`reason` names the thing, the value and the bound."""

    kind: ClassVar[str] = "refusal"
    max_bytes: ClassVar[int] = 4096

    reason: Annotated[str, Field(max_length=2000)]
