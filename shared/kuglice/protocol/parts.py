"""Large things in numbered parts of one batch each: larger puts are dropped even on an idle link."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from kuglice.errors import ProtocolError
from kuglice.protocol.messages.part import PART_BYTES, Part

__all__ = ["Assembly", "Whole", "split"]

Thing = Literal["about", "history", "snapshot"]


def split(data: bytes, *, of: Thing, epoch: int, tick: int) -> Iterator[Part]:
    """`data` in parts of at most PART_BYTES, in order. Nothing is one empty part."""
    count = max(1, -(-len(data) // PART_BYTES))
    for index in range(count):
        chunk = data[index * PART_BYTES : (index + 1) * PART_BYTES]
        yield Part(epoch=epoch, of=of, tick=tick, index=index, count=count, size=len(data), data=chunk)


class Whole(NamedTuple):
    """What the parts make together."""

    of: Thing
    epoch: int
    tick: int
    data: bytes


@dataclass
class _Pile:
    size: int
    parts: dict[int, bytes] = field(default_factory=dict)


class Assembly:
    """Puts parts together again, in whatever order they come; incomplete piles beyond `piles` give way to
    newer ones.

    `max_bytes` bounds one whole.
    """

    def __init__(self, *, max_bytes: int = 256 << 20, piles: int = 2) -> None:
        self._max_bytes = max_bytes
        self._piles = piles
        self._waiting: dict[tuple[Thing, int, int], _Pile] = {}
        self.given_up = 0

    def add(self, part: Part) -> Whole | None:
        """The whole, if this part was the last one missing.

        Raises ProtocolError for a part that does not belong.
        """
        if part.size > self._max_bytes:
            raise ProtocolError(f"{part.of}: {part.size} bytes, at most {self._max_bytes} allowed")
        key = (part.of, part.epoch, part.tick)
        pile = self._waiting.get(key)
        if pile is None:
            pile = self._waiting[key] = _Pile(part.size)
            while len(self._waiting) > self._piles:
                del self._waiting[next(iter(self._waiting))]
                self.given_up += 1
        elif pile.size != part.size:
            raise ProtocolError(
                f"{part.of} of tick {part.tick}: a part says {part.size} bytes, others {pile.size}"
            )
        pile.parts[part.index] = part.data
        if len(pile.parts) < part.count:
            return None
        del self._waiting[key]
        data = b"".join(pile.parts[index] for index in range(part.count))
        return Whole(part.of, part.epoch, part.tick, data)
