"""Past ticks, as an answer to a TickRange."""

from __future__ import annotations

from typing import ClassVar

from kuglice.protocol.messages.stretch import Stretch

__all__ = ["History"]


class History(Stretch):
    """What was asked for, as far as the server still has it: an answer may begin later or end earlier."""

    kind: ClassVar[str] = "history"
    max_bytes: ClassVar[int] = 64 << 20
