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
    max_reason: ClassVar[int] = 2000
    """Characters."""

    reason: Annotated[str, Field(max_length=max_reason)]
