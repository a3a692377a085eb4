"""What became of an input."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from kuglice.errors import ProtocolError
from kuglice.protocol.messages.envelope import U64, TickNumber
from kuglice.protocol.varint import Reader, write_signed, write_varint

__all__ = ["Ack", "read_ack", "write_ack"]

MAX_REASON_BYTES = 1600
REFUSED, SEQUENCE, EARLY = 1, 2, 4

Reason = Annotated[str, Field(max_length=400)]


class Ack(NamedTuple):
    """What became of an input.

    `tick` is the one it acts in, None if it was refused, and then `refused` says why. `early` is how many
    ticks before its turn it came (negative: too late for the tick it asked for), None where it is not told.
    `sequence` is None for a message that could not be read at all.
    """

    client: int
    sequence: U64 | None
    tick: TickNumber | None
    early: int | None
    refused: Reason | None

    @property
    def size(self) -> int:
        """Bytes that it takes in a message."""
        out = bytearray()
        write_ack(out, self)
        return len(out)


def write_ack(out: bytearray, ack: Ack) -> None:
    """Append it: a byte that says what is there, and that."""
    out.append(
        (REFUSED if ack.tick is None else 0)
        | (SEQUENCE if ack.sequence is not None else 0)
        | (EARLY if ack.early is not None else 0)
    )
    write_varint(out, ack.client)
    if ack.sequence is not None:
        write_varint(out, ack.sequence)
    if ack.early is not None:
        write_signed(out, ack.early)
    if ack.tick is not None:
        write_varint(out, ack.tick)
    else:
        reason = (ack.refused or "").encode()
        write_varint(out, len(reason))
        out += reason


def read_ack(source: Reader) -> Ack:
    """What write_ack wrote. Raises ProtocolError for anything else."""
    has = source.byte()
    client = source.varint(below=1 << 32)
    sequence = source.varint() if has & SEQUENCE else None
    early = source.signed() if has & EARLY else None
    if not has & REFUSED:
        return Ack(client, sequence, source.varint(below=1 << 62), early, None)
    try:
        reason = source.take(source.varint(below=MAX_REASON_BYTES + 1)).decode()
    except UnicodeDecodeError as error:
        raise ProtocolError(f"reason of a refusal: not UTF-8: {error}") from None
    return Ack(client, sequence, None, early, reason)
