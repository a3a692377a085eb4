"""Consecutive ticks, as the tick stream and the history carry them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, Self

import numpy as np
from pydantic import model_validator

from kuglice.protocol.messages.envelope import Message, TickNumber

__all__ = ["Stretch", "StretchedTick"]

HASH_BYTES = 8


class StretchedTick(NamedTuple):
    """Tick n: the packed inputs(n), and the hash of state(n + 1) that they led to."""

    tick: int
    inputs: bytes
    state_hash: int


class Stretch(Message):
    """Ticks first, first + 1, ...: `inputs` per tick as packed records, `hashes` as little-endian u64."""

    first: TickNumber
    inputs: list[bytes]
    hashes: bytes

    @model_validator(mode="after")
    def _as_many_hashes_as_inputs(self) -> Self:
        if len(self.hashes) != HASH_BYTES * len(self.inputs):
            raise ValueError(
                f"hashes: {len(self.hashes)} bytes for {len(self.inputs)} ticks, not {HASH_BYTES} each"
            )
        return self

    @property
    def end(self) -> int:
        """The tick after the last one."""
        return self.first + len(self.inputs)

    def ticks(self) -> Iterator[StretchedTick]:
        """Every tick of the stretch, in order."""
        hashes = np.frombuffer(self.hashes, dtype="<u8").tolist()
        for offset, (inputs, state_hash) in enumerate(zip(self.inputs, hashes, strict=True)):
            yield StretchedTick(self.first + offset, inputs, state_hash)

    @staticmethod
    def pack_hashes(hashes: list[int]) -> bytes:
        """The bytes that `hashes` holds."""
        return np.array(hashes, dtype="<u8").tobytes()
