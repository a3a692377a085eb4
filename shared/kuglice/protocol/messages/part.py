"""One numbered part of something that is larger than a message should be."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from kuglice.protocol.messages.envelope import Message, TickNumber

__all__ = ["PART_BYTES", "Part"]

PART_BYTES = 60_000
"""Payload of one part: with its envelope it stays below the 65,535 bytes of one Zenoh batch."""


class Part(Message):
    """Part `index` of `count` of the thing `of`, which is `size` bytes long and belongs to `tick`."""

    kind: ClassVar[str] = "part"
    max_bytes: ClassVar[int] = PART_BYTES + 512

    of: Literal["about", "history", "snapshot"]
    tick: TickNumber
    index: Annotated[int, Field(ge=0)]
    count: Annotated[int, Field(ge=1)]
    size: Annotated[int, Field(ge=0)]
    data: Annotated[bytes, Field(max_length=PART_BYTES)]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.index >= self.count:
            raise ValueError(f"index {self.index}: must be below count {self.count}")
        if self.count != max(1, -(-self.size // PART_BYTES)):
            raise ValueError(f"count {self.count}: {self.size} bytes do not come in that many parts")
        wanted = min(PART_BYTES, self.size - self.index * PART_BYTES)
        if len(self.data) != wanted:
            raise ValueError(
                f"data: {len(self.data)} bytes in part {self.index} of {self.count}, not {wanted}"
            )
        return self
