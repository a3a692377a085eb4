"""What is told of one node of the quadtree: all the balls whose centre lies in it."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import Field

from kuglice.protocol.messages.envelope import MAX_WHOLE_BYTES, CompactMessage, TickNumber
from kuglice.protocol.varint import Reader, write_varint

__all__ = ["MAX_REGION_BALLS", "Region"]

MAX_REGION_BALLS = 1 << 17
"""What a reader lets a message claim, whose balls may take less than a bit each."""


class Region(CompactMessage):
    """The balls of `node` in state(`tick`), packed by `_core.Regions` as the terms of the server say.

    The list is full: whoever is not in it was not there. The newest tick wins. On the wire: epoch, tick, node
    (varints), and the packed balls (core/regions/src/pack.rs).
    """

    kind: ClassVar[str] = "region"
    letter: ClassVar[bytes] = b"r"
    max_bytes: ClassVar[int] = MAX_WHOLE_BYTES

    tick: TickNumber
    node: Annotated[int, Field(ge=0, lt=1 << 16)]
    balls: bytes

    def write(self, out: bytearray) -> None:
        """Append the fields."""
        for number in (self.epoch, self.tick, self.node):
            write_varint(out, number)
        out += self.balls

    @classmethod
    def read(cls, data: bytes) -> Self:
        """What `write` wrote."""
        source = Reader(data)
        epoch, tick, node = source.varint(), source.varint(below=1 << 62), source.varint(below=1 << 16)
        return cls(epoch=epoch, tick=tick, node=node, balls=source.take(source.left))
