"""The authoritative stream: one message per tick, repeating the last few."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, ClassVar, Self

from pydantic import Field

from kuglice.errors import ProtocolError
from kuglice.inputs.record import RECORD
from kuglice.protocol.compact import pack_ticks, unpack_ticks
from kuglice.protocol.messages.ack import Ack, read_ack, write_ack
from kuglice.protocol.messages.envelope import U64, CompactMessage
from kuglice.protocol.messages.stretch import HASH_BYTES, Stretch, StretchedTick
from kuglice.protocol.varint import Reader, write_varint

__all__ = ["MAX_TOLD_TICKS", "Tick"]

MAX_TOLD_TICKS = 64
"""Ticks per message, the newest and those repeated."""
HASHED, ACKED = 0x40, 0x80


class Tick(CompactMessage, Stretch):
    """Tick `end - 1` and those before it that somebody may have missed, so that a lost message heals with the next.

    Only the newest tick has a hash: one that is wrong stays wrong, so a hash that was lost is made up for by
    the next. An input that acts here is acknowledged by being here; `acks` says the rest.

    On the wire: epoch and newest tick (varints); a byte with the number of ticks, less one, and whether
    there are hash (0x40) and acks (0x80); those; the inputs (protocol/compact.py).
    """

    kind: ClassVar[str] = "tick"
    letter: ClassVar[bytes] = b"t"
    max_bytes: ClassVar[int] = 65_535
    max_record_bytes: ClassVar[int] = 4 << 20

    inputs: Annotated[list[bytes], Field(min_length=1, max_length=MAX_TOLD_TICKS)]
    state_hash: U64 | None
    acks: Annotated[list[Ack], Field(max_length=4096, strict=False)]

    @classmethod
    def of(cls, epoch: int, ticks: Sequence[StretchedTick], acks: Sequence[Ack] = ()) -> Self:
        """A message of ticks in order, at least one."""
        return cls(
            epoch=epoch,
            first=ticks[0].tick,
            inputs=[entry.inputs for entry in ticks],
            state_hash=ticks[-1].state_hash,
            acks=list(acks),
        )

    def state_hashes(self) -> Iterable[int | None]:
        """That of the newest."""
        return [None] * (len(self.inputs) - 1) + [self.state_hash]

    def outcomes(self, client: int) -> Iterator[Ack]:
        """What became of inputs of that client: what is said, and what is seen to act."""
        told = set()
        for ack in self.acks:
            if ack.client == client:
                told.add(ack.sequence)
                yield ack
        for ack in self.acting(client):
            if ack.sequence not in told:
                yield ack

    def write(self, out: bytearray) -> None:
        """Append the fields."""
        newest = self.end - 1
        acting = {(who, number) for _, who, number, *_ in RECORD.iter_unpack(self.inputs[-1])}
        early, said = {}, []
        for ack in self.acks:
            about = (ack.client, ack.sequence)
            # What became of an input that acts in the newest tick goes with the input itself.
            if ack.tick == newest and about in acting and ack.early is not None:
                early[ack.client, ack.sequence or 0] = ack.early
            else:
                said.append(ack)
        write_varint(out, self.epoch)
        write_varint(out, newest)
        out.append(
            len(self.inputs) - 1 | (HASHED if self.state_hash is not None else 0) | (ACKED if said else 0)
        )
        if self.state_hash is not None:
            out += self.state_hash.to_bytes(HASH_BYTES, "little")
        if said:
            write_varint(out, len(said))
            for ack in said:
                write_ack(out, ack)
        pack_ticks(out, self.inputs, early)

    @classmethod
    def read(cls, data: bytes) -> Self:
        """What `write` wrote."""
        source = Reader(data)
        epoch, newest, told = source.varint(), source.varint(below=1 << 62), source.byte()
        count = (told & MAX_TOLD_TICKS - 1) + 1
        if count > newest + 1:
            raise ProtocolError(f"tick {newest}: {count} ticks up to it, at most {newest + 1} there are")
        state_hash = int.from_bytes(source.take(HASH_BYTES), "little") if told & HASHED else None
        acks = [read_ack(source) for _ in range(source.varint(below=4097))] if told & ACKED else []
        inputs, early = unpack_ticks(source, count, max_bytes=cls.max_record_bytes)
        acks += [Ack(client, sequence, newest, lead, None) for (client, sequence), lead in early.items()]
        return cls(epoch=epoch, first=newest + 1 - count, inputs=inputs, state_hash=state_hash, acks=acks)
