"""Input records in few bytes, and exactly: what comes out has every bit of what went in.

A record of the step takes 69 bytes, most of them 0. Here it takes a head byte and what the head says is needed:

    bits 0-2  kind, as in _core.INPUT_KINDS; 7 is a kick that names a ball
    bits 3-4  numbers as 0: binary16, 1: binary32, 2: binary64, 3: two bits for each of them go first
    bit 5     `early` follows (signed varint): how many ticks before its turn the input came
    bit 6     same client as the record before it (the first one: client 0), else a varint follows
    bit 7     sequence is one more than that client's last (the first one: 1), else the difference follows (signed)

then the ball (varint), where the kind has one, and the numbers. A number goes in the shortest format that has its
very value, the sign of a zero included. NaN is no number here.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence

from kuglice import _core
from kuglice.errors import ProtocolError
from kuglice.inputs.record import NUMBERS, RECORD
from kuglice.protocol.varint import Reader, write_signed, write_varint

__all__ = ["RecordReader", "RecordWriter", "pack_ticks", "packed_size", "unpack_ticks"]

KICK = _core.INPUT_KINDS.index("kick")
REMOVE = _core.INPUT_KINDS.index("remove")
KICK_BALL = 7
COUNTS = [len(NUMBERS[kind]) for kind in _core.INPUT_KINDS]
FORMATS = "efd"
SIZES = (2, 4, 8)
MIXED = 3
EARLY, SAME_CLIENT, NEXT_SEQUENCE = 1 << 5, 1 << 6, 1 << 7
FEW = 3
"""Records of one tick that its head counts; a varint counts the rest."""

Early = Mapping[tuple[int, int], int]


class RecordWriter:
    """Appends records to `out`."""

    def __init__(self, out: bytearray) -> None:
        self.out = out
        self._client = 0
        self._sequences: dict[int, int] = {}

    def write(self, record: bytes, early: Early | None = None) -> None:
        """One record of the step.

        Raises ProtocolError for one that `_core` would not read. `early` is by client and sequence number.
        """
        kind, client, sequence, ball, *numbers = RECORD.unpack(record)
        if kind >= len(COUNTS):
            raise ProtocolError(f"input record: kind {kind}, must be less than {len(COUNTS)}")
        name, named = _core.INPUT_KINDS[kind], ball != _core.NO_BALL
        if kind != KICK and named != (kind == REMOVE):
            raise ProtocolError(f"input record: {name} {'names' if named else 'without'} a ball")
        if any(record[RECORD.size - 8 * (6 - COUNTS[kind]) :]):
            raise ProtocolError(f"input record: {name} with unused numbers not 0")
        width, written = _written(numbers[: COUNTS[kind]])
        lead = None if early is None else early.get((client, sequence))
        last = self._sequences.get(client, 0)
        head = KICK_BALL if kind == KICK and named else kind
        head |= width << 3
        head |= EARLY if lead is not None else 0
        head |= SAME_CLIENT if client == self._client else 0
        head |= NEXT_SEQUENCE if sequence == last + 1 else 0
        self.out.append(head)
        if not head & SAME_CLIENT:
            write_varint(self.out, client)
        if not head & NEXT_SEQUENCE:
            write_signed(self.out, sequence - last)
        if lead is not None:
            write_signed(self.out, lead)
        if named:
            write_varint(self.out, ball)
        self.out += written
        self._client = client
        self._sequences[client] = sequence


class RecordReader:
    """Reads what RecordWriter wrote; `early` is what the records said of it."""

    def __init__(self, source: Reader) -> None:
        self._source = source
        self._client = 0
        self._sequences: dict[int, int] = {}
        self.early: dict[tuple[int, int], int] = {}

    def read(self) -> bytes:
        """The next record of the step. Raises ProtocolError for bytes that are none."""
        source = self._source
        head = source.byte()
        kind = KICK if head & 7 == KICK_BALL else head & 7
        client = self._client if head & SAME_CLIENT else source.varint(below=1 << 32)
        last = self._sequences.get(client, 0)
        sequence = last + (1 if head & NEXT_SEQUENCE else source.signed())
        if not 0 <= sequence < 1 << 64:
            raise ProtocolError(f"input record: sequence {sequence}, must be 0 to 2**64 - 1")
        if head & EARLY:
            self.early[client, sequence] = source.signed()
        named = head & 7 == KICK_BALL or kind == REMOVE
        ball = source.varint(below=_core.NO_BALL) if named else _core.NO_BALL
        numbers = _read(source, head >> 3 & 3, COUNTS[kind])
        self._client = client
        self._sequences[client] = sequence
        return RECORD.pack(kind, client, sequence, ball, *numbers, *[0.0] * (6 - len(numbers)))


def pack_ticks(out: bytearray, inputs: Sequence[bytes], early: Early | None = None) -> None:
    """Append the records of consecutive ticks, to the end of the message; ticks without any take no byte."""
    writer = RecordWriter(out)
    last = -1
    for offset, records in enumerate(inputs):
        if not records:
            continue
        count, rest = divmod(len(records), RECORD.size)
        if rest:
            raise ProtocolError(f"input records: {len(records)} bytes, must be a multiple of {RECORD.size}")
        few = min(count - 1, FEW)
        write_varint(out, (offset - last - 1) << 2 | few)
        if few == FEW:
            write_varint(out, count - 1 - FEW)
        for at in range(0, len(records), RECORD.size):
            writer.write(records[at : at + RECORD.size], early)
        last = offset


def packed_size(inputs: bytes) -> int:
    """Bytes that one tick's records take in a message, at most about."""
    out = bytearray()
    pack_ticks(out, [inputs])
    return len(out)


def unpack_ticks(
    source: Reader, ticks: int, *, max_bytes: int
) -> tuple[list[bytes], dict[tuple[int, int], int]]:
    """The records of each of so many ticks, and what was said of `early`.

    Raises ProtocolError for bytes that are no records, and for more than `max_bytes` of records.
    """
    inputs = [b""] * ticks
    reader = RecordReader(source)
    last, size = -1, 0
    while source.left:
        head = source.varint()
        last += 1 + (head >> 2)
        if last >= ticks:
            raise ProtocolError(f"inputs of tick {last} of {ticks}")
        count = (head & 3) + 1
        if head & 3 == FEW:
            count += source.varint()
        size += count * RECORD.size
        if size > max_bytes:
            raise ProtocolError(f"input records: {size} bytes, at most {max_bytes} allowed")
        inputs[last] = b"".join([reader.read() for _ in range(count)])
    return inputs, reader.early


def _width(number: float) -> int:
    """Index of the shortest format that has this very value, both zeros included."""
    for width, form in enumerate(FORMATS[:2]):
        try:
            if struct.unpack(f"<{form}", struct.pack(f"<{form}", number))[0] == number:
                return width
        except OverflowError:
            continue
    return 2


def _written(numbers: Sequence[float]) -> tuple[int, bytes]:
    _refuse_nan(numbers)
    if not numbers:
        return 0, b""
    # A positive zero takes no byte of its own where each number has its own width.
    widths = [_width(number) for number in numbers]
    codes = [
        0 if number == 0 and math.copysign(1.0, number) > 0 else width + 1
        for number, width in zip(numbers, widths, strict=True)
    ]
    widest = max(widths)
    mask_bytes = 1 if len(numbers) <= 4 else 2
    if mask_bytes + sum(SIZES[code - 1] for code in codes if code) < len(numbers) * SIZES[widest]:
        mask = sum(code << 2 * place for place, code in enumerate(codes))
        forms = "".join(FORMATS[code - 1] for code in codes if code)
        values = [number for number, code in zip(numbers, codes, strict=True) if code]
        return MIXED, mask.to_bytes(mask_bytes, "little") + struct.pack(f"<{forms}", *values)
    return widest, struct.pack(f"<{len(numbers)}{FORMATS[widest]}", *numbers)


def _read(source: Reader, width: int, count: int) -> tuple[float, ...]:
    if width == MIXED:
        mask = int.from_bytes(source.take(1 if count <= 4 else 2), "little")
        codes = [mask >> 2 * place & 3 for place in range(count)]
        forms = "".join(FORMATS[code - 1] for code in codes if code)
        values = iter(struct.unpack(f"<{forms}", source.take(sum(SIZES[code - 1] for code in codes if code))))
        numbers = tuple(next(values) if code else 0.0 for code in codes)
    else:
        numbers = struct.unpack(f"<{count}{FORMATS[width]}", source.take(count * SIZES[width]))
    _refuse_nan(numbers)
    return numbers


def _refuse_nan(numbers: Sequence[float]) -> None:
    if any(map(math.isnan, numbers)):
        raise ProtocolError(f"input record: numbers {', '.join(map(str, numbers))}, NaN is none")
