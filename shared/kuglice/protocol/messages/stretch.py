"""Consecutive ticks, as the tick stream and the history carry them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from kuglice.inputs.record import OF_THE_SERVER, RECORD
from kuglice.protocol.messages.ack import Ack
from kuglice.protocol.messages.envelope import Message, TickNumber

__all__ = ["HASH_BYTES", "Stretch", "StretchedTick"]

HASH_BYTES = 8


class StretchedTick(NamedTuple):
    """Tick n: the packed inputs(n), and the hash of state(n + 1) that they led to, None where it is not told."""

    tick: int
    inputs: bytes
    state_hash: int | None


class Stretch(Message):
    """Ticks first, first + 1, ...: `inputs` per tick as packed records of the step."""

    first: TickNumber
    inputs: list[bytes]

    @property
    def end(self) -> int:
        """The tick after the last one."""
        return self.first + len(self.inputs)

    def ticks(self) -> Iterator[StretchedTick]:
        """Every tick of the stretch, in order."""
        hashes = self.state_hashes()
        for offset, (inputs, state_hash) in enumerate(zip(self.inputs, hashes, strict=True)):
            yield StretchedTick(self.first + offset, inputs, state_hash)

    def acting(self, client: int) -> Iterator[Ack]:
        """Own inputs of that client that act in these ticks: to be in them is to be acknowledged."""
        for tick, records in enumerate(self.inputs, self.first):
            for kind, who, sequence, *_ in RECORD.iter_unpack(records):
                if who == client and kind not in OF_THE_SERVER:
                    yield Ack(client, sequence, tick, None, None)

    @abstractmethod
    def state_hashes(self) -> Iterable[int | None]:
        """One per tick, None where it is not told."""
