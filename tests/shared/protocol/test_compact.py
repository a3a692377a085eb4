"""Records come out of their compact form with every bit, and hostile bytes are refused in words."""

from __future__ import annotations

import contextlib
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice import _core
from kuglice.errors import ProtocolError
from kuglice.inputs import Attract, Kick, Spawn, Thrust, pack
from kuglice.inputs.record import RECORD
from kuglice.protocol.compact import RecordReader, RecordWriter, pack_ticks, packed_size, unpack_ticks
from kuglice.protocol.varint import Reader, write_signed, write_varint
from shared.protocol.some_records import some_records

MUCH = 1 << 20


def written(record: bytes) -> bytes:
    out = bytearray()
    RecordWriter(out).write(record)
    return bytes(out)


@given(st.lists(some_records(), max_size=8), st.data())
def test_every_bit_of_every_record_comes_back(inputs, data):
    out = bytearray()
    keys = [(who, number) for records in inputs for _, who, number, *_ in RECORD.iter_unpack(records)]
    early = {key: data.draw(st.integers(-(2**40), 2**40)) for key in keys if data.draw(st.booleans())}
    pack_ticks(out, inputs, early)
    received, told = unpack_ticks(Reader(bytes(out)), len(inputs), max_bytes=MUCH)
    assert received == inputs
    assert told == early


@given(st.integers(0, 2**64 - 1), st.integers(-(2**64), 2**64))
def test_whole_numbers_come_back(whole, signed):
    out = bytearray()
    write_varint(out, whole)
    write_signed(out, signed)
    source = Reader(bytes(out))
    assert (source.varint(), source.signed(), source.left) == (whole, signed, 0)


@pytest.mark.parametrize(
    ("one", "size"),
    [
        (Thrust(sequence=1, x=1.5, y=-0.25), 5),
        (Thrust(sequence=2, x=1.5, y=-0.25), 6),
        (Thrust(client=5, sequence=1, x=1.5, y=-0.25), 6),
        (Thrust(sequence=1, x=2.0**-20 + 1, y=1.0), 8),
        (Thrust(sequence=1, x=0.1, y=-0.0), 12),
        (Thrust(sequence=1, x=0.1, y=0.2), 17),
        (Attract(sequence=1, x=0.1, y=0.2, strength=0.0), 18),
        (Kick(sequence=1, vx=1.0, vy=0.0, ball=3), 5),
        (Spawn(sequence=1, x=0.1, y=0.2, radius=0.5, mass=1.0), 23),
    ],
)
def test_a_record_takes_no_more_than_its_numbers_need(one, size):
    assert len(written(pack([one]))) == size


@given(st.binary(max_size=60), st.integers(0, 5))
def test_whatever_the_bytes_are_they_are_records_or_refused(data, ticks):
    with contextlib.suppress(ProtocolError):
        inputs, _ = unpack_ticks(Reader(data), ticks, max_bytes=MUCH)
        again = bytearray()
        pack_ticks(again, inputs)
        assert unpack_ticks(Reader(bytes(again)), ticks, max_bytes=MUCH)[0] == inputs


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"\x80" * 11, "more than 10 bytes"),
        (b"\x04\xc4", "inputs of tick 1 of 1"),
        (b"\x03\xff\xff\xff\x7f", "bytes, at most 1048576 allowed"),
        (b"\x00\xc4\x00\x7e\x00\x00", "NaN is none"),
        (b"\x00\xc4\x00", "4 more wanted, 1 left"),
        (b"\x00\x44\x01\x00\x00\x00\x00", "sequence -1, must be 0 to"),
        (b"\x00\xc3" + b"\xff" * 9 + b"\x01", "must be less than 18446744073709551615"),
    ],
)
def test_a_refusal_names_what_is_wrong(data, message):
    with pytest.raises(ProtocolError, match=message):
        unpack_ticks(Reader(data), 1, max_bytes=MUCH)


def record(kind: int, ball: int = _core.NO_BALL, numbers: tuple[float, ...] = (0.0,) * 6) -> bytes:
    return RECORD.pack(kind, 1, 1, ball, *numbers)


@pytest.mark.parametrize(
    ("records", "message"),
    [
        (record(7), "kind 7, must be less than 7"),
        (record(4, ball=3), "thrust names a ball"),
        (record(3), "remove without a ball"),
        (record(4, numbers=(1.0, 1.0, -0.0, 0.0, 0.0, 0.0)), "thrust with unused numbers not 0"),
        (record(4, numbers=(float("nan"), 1.0, 0.0, 0.0, 0.0, 0.0)), "NaN is none"),
        (bytes(70), "70 bytes, must be a multiple of 69"),
    ],
)
def test_what_the_step_would_not_read_is_not_written(records, message):
    with pytest.raises(ProtocolError, match=message):
        packed_size(records)


def test_a_number_of_a_remove_has_all_64_bits_but_the_one_that_is_no_ball():
    highest = record(3, ball=_core.NO_BALL - 1)
    assert RecordReader(Reader(written(highest))).read() == highest


@given(st.floats(allow_nan=False))
def test_a_single_number_keeps_its_bits_in_whatever_width_it_goes(number):
    thrust = record(4, numbers=(number, 1.0, 0.0, 0.0, 0.0, 0.0))
    found = RECORD.unpack(RecordReader(Reader(written(thrust))).read())[4]
    assert struct.pack("<d", found) == struct.pack("<d", number)
