"""Whatever the bytes are, decoding ends in a valid message or in a ProtocolError."""

from __future__ import annotations

import contextlib

import msgpack
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import ProtocolError
from kuglice.inputs import Join, Thrust, pack
from kuglice.protocol import (
    PROTOCOL_VERSION,
    Ack,
    ClientInputs,
    History,
    SentInput,
    SnapshotRequest,
    StretchedTick,
    Tick,
    TickRange,
    decode,
    encode,
)
from kuglice.protocol.varint import write_varint
from shared.protocol.some_records import some_records

u64 = st.integers(0, 2**64 - 1)
tick_numbers = st.integers(0, 2**40)
acks = st.builds(
    Ack,
    st.integers(0, 2**32 - 1),
    st.none() | u64,
    st.just(None),
    st.none() | st.integers(-1000, 1000),
    st.text(max_size=100),
) | st.builds(
    Ack, st.integers(0, 2**32 - 1), u64, tick_numbers, st.none() | st.integers(-1000, 1000), st.none()
)
per_tick = st.lists(st.tuples(some_records(), st.none() | u64), min_size=1, max_size=8)


def stretched(first: int, ticks: list) -> list[StretchedTick]:
    return [StretchedTick(first + at, *each) for at, each in enumerate(ticks)]


def a_tick() -> Tick:
    thrust = pack([Thrust(client=2, sequence=9, x=0.5, y=0.1)])
    return Tick.of(
        7, stretched(3, [(b"", None), (thrust, 2)]), [Ack(2, 9, 4, 1, None), Ack(2, 8, None, 1, "no")]
    )


@given(u64, tick_numbers, per_tick, st.lists(acks, max_size=5))
def test_a_tick_message_survives_the_wire_with_every_bit(epoch, first, ticks, acks):
    sent = Tick.of(epoch, stretched(first, ticks), acks)
    received = decode(encode(sent), Tick)
    assert received == sent
    assert [(entry.tick, entry.inputs) for entry in received.ticks()] == [
        (first + at, inputs) for at, (inputs, _) in enumerate(ticks)
    ]
    assert [entry.state_hash for entry in received.ticks()] == [None] * (len(ticks) - 1) + [ticks[-1][1]]


@given(tick_numbers, st.lists(st.tuples(some_records(), u64), min_size=1, max_size=20), st.integers(1, 7))
def test_an_answer_of_the_history_survives_the_wire_with_every_bit(first, ticks, every):
    told = [
        entry if (entry.tick + 1) % every == 0 else entry._replace(state_hash=None)
        for entry in stretched(first, ticks)
    ]
    received = decode(encode(History.of(7, told, hash_every=every)), History)
    assert list(received.ticks()) == told


def test_an_input_that_acts_is_acknowledged_by_acting_and_how_early_it_came_goes_with_it():
    received = decode(encode(a_tick()), Tick)
    assert sorted(received.outcomes(2), key=lambda ack: ack.sequence) == [
        Ack(2, 8, None, 1, "no"),
        Ack(2, 9, 4, 1, None),
    ]
    assert list(received.outcomes(3)) == []
    again = Tick.of(7, [*a_tick().ticks(), StretchedTick(5, b"", 3)])
    assert list(decode(encode(again), Tick).outcomes(2)) == [Ack(2, 9, 4, None, None)]


def test_what_the_server_did_to_a_client_is_no_outcome_of_an_input_of_its_own():
    told = Tick.of(7, stretched(3, [(pack([Join(client=2, sequence=9)]), 1)]))
    assert list(told.outcomes(2)) == []


def test_a_tick_without_inputs_takes_a_few_bytes_whatever_it_repeats():
    epoch, tick = 2**28 - 1, 2**21 - 1
    for count in (1, 6, 64):
        ticks = stretched(tick + 1 - count, [(b"", 2**64 - 1)] * count)
        assert len(encode(Tick.of(epoch, ticks))) == 18


LETTERS = (Tick.letter, ClientInputs.letter)
"""After one of them, and the version, other bytes may well be a message."""
finite = st.floats(allow_nan=False, allow_infinity=False)


@given(tick_numbers, st.lists(st.tuples(tick_numbers, finite, finite, u64), max_size=20))
def test_inputs_of_a_client_survive_the_wire_with_every_bit(heard, inputs):
    sent = ClientInputs(
        epoch=1,
        heard=heard,
        inputs=[SentInput(tick, Thrust(sequence=number, x=x, y=y)) for tick, x, y, number in inputs],
    )
    received = decode(encode(sent), ClientInputs)
    assert received == sent
    assert [pack([one.given]) for one in received.inputs] == [pack([one.given]) for one in sent.inputs]


@given(st.binary(max_size=400).filter(lambda data: data[:1] not in LETTERS))
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
        (b"\x93" * 60_000, "not msgpack"),
        (b"\xdd\xff\xff\xff\xff", "not msgpack"),
        (msgpack.packb([1, 2]), "a list, not a map"),
        (msgpack.packb({"kind": "tick"}), "protocol version None, this side speaks"),
        (msgpack.packb({"v": 999, "kind": "tick"}), "protocol version 999, this side speaks"),
        (msgpack.packb({"v": PROTOCOL_VERSION, "kind": "dance"}), "message 'dance': expected 'tick'"),
        (msgpack.packb({"v": PROTOCOL_VERSION, "kind": "tick"}), "message 'tick': expected 'tick'"),
        (bytes((*b"t", PROTOCOL_VERSION)), "byte 0: 1 more wanted, 0 left"),
        (b"t", "protocol version None, this side speaks"),
        (b"t\x02", "protocol version 2, this side speaks"),
        (msgpack.packb({"t": b"\x03"}), "protocol version None, this side speaks"),
        (bytes((*b"i", PROTOCOL_VERSION)), "message 'tick': not msgpack"),
        (msgpack.packb({"v": PROTOCOL_VERSION, "t": 5}), r"message \['t'\]: expected 'tick'"),
        (bytes(Tick.max_bytes + 1), f"{Tick.max_bytes + 1} bytes, at most {Tick.max_bytes} allowed"),
    ],
)
def test_a_refusal_names_what_is_wrong(data, message):
    with pytest.raises(ProtocolError, match=message):
        decode(data, Tick)


def test_a_message_is_held_to_the_bound_of_its_own_kind_among_several():
    data = encode(ClientInputs(epoch=1, heard=1, inputs=[])) + b"\xc0" * ClientInputs.max_bytes
    with pytest.raises(ProtocolError):
        decode(data, ClientInputs, Tick)


def test_a_hash_is_missing():
    body = msgpack.unpackb(encode(History.of(7, stretched(3, [(b"", 1), (b"", 2)]))))
    body["hashes"] = body["hashes"][:-8]
    with pytest.raises(ProtocolError, match="8 bytes for 2 hashes of 2 ticks"):
        decode(msgpack.packb(body), History)


@pytest.mark.parametrize("ticks", [None, -1, 2**40, "many", True])
def test_a_history_that_claims_more_ticks_than_there_can_be_is_refused(ticks):
    body = msgpack.unpackb(encode(History.of(7, stretched(3, [(b"", 1)]))))
    with pytest.raises(ProtocolError):
        decode(msgpack.packb({**body, "ticks": ticks, "hashes": b""}), History)


def test_a_stretch_that_begins_before_the_first_tick_is_refused():
    out = bytearray((*b"t", PROTOCOL_VERSION))
    write_varint(out, 7)
    write_varint(out, 3)
    out.append(4)
    with pytest.raises(ProtocolError, match="tick 3: 5 ticks up to it, at most 4 there are"):
        decode(bytes(out), Tick)


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
        encode(Tick.of(1, [StretchedTick(0, b"", 1)], [Ack(1, 1, None, 0, "no" * 100)] * 1000))
