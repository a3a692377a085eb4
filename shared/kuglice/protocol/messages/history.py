"""Past ticks, as an answer to a TickRange."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from pydantic import Field, model_validator

from kuglice.protocol.compact import pack_ticks, unpack_ticks
from kuglice.protocol.messages.stretch import HASH_BYTES, Stretch, StretchedTick
from kuglice.protocol.varint import Reader

__all__ = ["History"]

MAX_TICKS = 1 << 20


class History(Stretch):
    """What was asked for, as far as the server still has it: an answer may begin later or end earlier.

    `hashes` are little-endian u64, one for each tick whose state's number is a multiple of `hash_every`.
    """

    kind: ClassVar[str] = "history"
    max_bytes: ClassVar[int] = 64 << 20

    hash_every: Annotated[int, Field(ge=1)] = 1
    hashes: bytes

    @model_validator(mode="after")
    def _as_many_hashes_as_told(self) -> Self:
        told = self.end // self.hash_every - self.first // self.hash_every
        if len(self.hashes) != HASH_BYTES * told:
            raise ValueError(
                f"hashes: {len(self.hashes)} bytes for {told} hashes of {len(self.inputs)} ticks, "
                f"not {HASH_BYTES} each"
            )
        return self

    @classmethod
    def of(cls, epoch: int, ticks: Sequence[StretchedTick], *, hash_every: int = 1) -> Self:
        """A message of ticks in order, at least one."""
        hashes = [entry.state_hash for entry in ticks if (entry.tick + 1) % hash_every == 0]
        return cls(
            epoch=epoch,
            first=ticks[0].tick,
            inputs=[entry.inputs for entry in ticks],
            hash_every=hash_every,
            hashes=np.array(hashes, dtype="<u8").tobytes(),
        )

    def state_hashes(self) -> Iterable[int | None]:
        """As `hashes` has them."""
        hashes = iter(np.frombuffer(self.hashes, dtype="<u8").tolist())
        for tick in range(self.first, self.end):
            yield next(hashes) if (tick + 1) % self.hash_every == 0 else None

    def to_body(self) -> dict[str, Any]:
        """With the inputs in their compact form."""
        packed = bytearray()
        pack_ticks(packed, self.inputs)
        return {**super().to_body(), "ticks": len(self.inputs), "inputs": bytes(packed)}

    @classmethod
    def from_body(cls, body: dict[str, Any]) -> Self:
        """What to_body made."""
        ticks, packed = body.pop("ticks", None), body.get("inputs")
        if not isinstance(packed, bytes) or not isinstance(ticks, int) or not 0 <= ticks <= MAX_TICKS:
            return cls.model_validate(body)
        inputs, _ = unpack_ticks(Reader(packed), ticks, max_bytes=cls.max_bytes)
        return cls.model_validate({**body, "inputs": inputs})
