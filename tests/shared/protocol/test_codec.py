"""Whatever the bytes are, decoding ends in a valid message or in a ProtocolError."""

from __future__ import annotations

import contextlib

import msgpack
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import ProtocolError
from kuglice.protocol import (
    PROTOCOL_VERSION,
    Ack,
    ClientInputs,
    History,
    SentInput,
    SnapshotRequest,
    Stretch,
    Tick,
    TickRange,
    decode,
    encode,
)

u64 = st.integers(0, 2**64 - 1)
tick_numbers = st.integers(0, 2**40)
acks = st.builds(
    Ack,
    st.integers(0, 2**32 - 1),
    st.none() | u64,
    st.none() | tick_numbers,
    st.integers(-1000, 1000),
    st.none() | st.text(max_size=100),
)
per_tick = st.lists(st.tuples(st.binary(max_size=200), u64), max_size=8)


def a_tick() -> Tick:
    return Tick(epoch=7, first=3, inputs=[b"", b"x"], hashes=Stretch.pack_hashes([1, 2]), acks=[])


@given(u64, tick_numbers, per_tick, st.lists(acks, max_size=5))
def test_a_tick_message_survives_the_wire_with_every_bit(epoch, first, ticks, acks):
    sent = Tick(
        epoch=epoch,
        first=first,
        inputs=[inputs for inputs, _ in ticks],
        hashes=Stretch.pack_hashes([state_hash for _, state_hash in ticks]),
        acks=acks,
    )
    received = decode(encode(sent), Tick)
    assert received == sent
    assert [(entry.inputs, entry.state_hash) for entry in received.ticks()] == ticks
    assert [entry.tick for entry in received.ticks()] == list(range(first, received.end))


@given(st.lists(st.floats(allow_nan=False), min_size=1, max_size=6))
def test_numbers_of_an_input_keep_every_bit(numbers):
    act = {"kind": "thrust", "numbers": numbers}
    sent = ClientInputs(epoch=1, inputs=[SentInput(sequence=1, tick=1, act=act)])
    received = decode(encode(sent), ClientInputs).inputs[0].act["numbers"]
    assert [number.hex() for number in received] == [number.hex() for number in numbers]


@given(st.binary(max_size=400))
def test_random_bytes_are_refused(data):
    with pytest.raises(ProtocolError):
        decode(data, Tick, History, ClientInputs)


@given(st.data())
def test_damaged_bytes_are_read_or_refused_never_anything_else(data):
    damaged = bytearray(encode(a_tick()))
    for _ in range(data.draw(st.integers(1, 4))):
        damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    with contextlib.suppress(ProtocolError):
        assert isinstance(decode(bytes(damaged), Tick), Tick)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "not msgpack"),
        (b"\x93" * 100_000, "not msgpack"),
        (b"\xdd\xff\xff\xff\xff", "not msgpack"),
        (msgpack.packb([1, 2]), "a list, not a map"),
        (msgpack.packb({"kind": "tick"}), "protocol version None, this side speaks"),
        (msgpack.packb({"v": 999, "kind": "tick"}), "protocol version 999, this side speaks"),
        (msgpack.packb({"v": PROTOCOL_VERSION, "kind": "dance"}), "message 'dance': expected 'tick'"),
        (msgpack.packb({"v": PROTOCOL_VERSION, "kind": "tick"}), "epoch: missing"),
        (bytes(Tick.max_bytes + 1), f"{Tick.max_bytes + 1} bytes, at most {Tick.max_bytes} allowed"),
    ],
)
def test_a_refusal_names_what_is_wrong(data, message):
    with pytest.raises(ProtocolError, match=message):
        decode(data, Tick)


def test_a_message_is_held_to_the_bound_of_its_own_kind_among_several():
    big = ClientInputs(epoch=1, inputs=[]).model_copy(update={"epoch": 1})
    data = encode(big) + b"\xc0" * ClientInputs.max_bytes
    with pytest.raises(ProtocolError):
        decode(data, ClientInputs, Tick)


def test_a_hash_is_missing():
    body = msgpack.unpackb(encode(a_tick()))
    body["hashes"] = body["hashes"][:-8]
    with pytest.raises(ProtocolError, match="8 bytes for 2 ticks"):
        decode(msgpack.packb(body), Tick)


def test_an_unknown_field_is_refused():
    body = msgpack.unpackb(encode(SnapshotRequest(epoch=1, at=None)))
    with pytest.raises(ProtocolError, match="spin"):
        decode(msgpack.packb({**body, "spin": 1}), SnapshotRequest)


def test_an_empty_range_of_ticks_is_refused():
    body = {"v": PROTOCOL_VERSION, "kind": "ticks?", "epoch": 1, "first": 5, "end": 5}
    with pytest.raises(ProtocolError, match="end 5: must be above first 5"):
        decode(msgpack.packb(body), TickRange)


def test_what_is_too_large_is_not_even_sent():
    with pytest.raises(ProtocolError, match="at most"):
        encode(Tick(epoch=1, first=0, inputs=[bytes(2 << 20)], hashes=bytes(8), acks=[]))
