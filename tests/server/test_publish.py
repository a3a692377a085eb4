"""What is published unasked fits into one batch, and always tells the newest tick."""

from __future__ import annotations

import socket

import pytest
import zenoh

from kuglice._core import INPUT_BYTES
from kuglice.inputs import Spawn, Thrust, pack
from kuglice.protocol import (
    Ack,
    Assembly,
    Keys,
    Part,
    StretchedTick,
    Tick,
    close_session,
    decode,
    open_session,
    server_configuration,
)
from kuglice_server.counters import Counters
from kuglice_server.intake import MAX_ACKS, MAX_PER_TICK, MAX_REASON
from kuglice_server.publish import Publisher
from kuglice_server.repeats import DATAGRAM_BYTES

BATCH = 65_535


@pytest.fixture
def wire():
    """A publisher, and what a subscriber in the same session hears of it."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    session = open_session(server_configuration(listen=[endpoint], connect=[]))
    keys = Keys("test")
    heard = session.declare_subscriber("kuglice/test/**", zenoh.handlers.FifoChannel(1000))
    publisher = Publisher(session, keys, epoch=9, rate=60, counters=Counters())

    def payloads() -> list[bytes]:
        found = []
        while (sample := heard.try_recv()) is not None:
            found.append(sample.payload.to_bytes())
        return found

    yield publisher, payloads
    close_session(session, [*publisher.declared, heard])


def ticks(count: int, inputs_each: int) -> list[StretchedTick]:
    one = [Thrust(client=1, sequence=number + 1, x=0.1 * number, y=0.3) for number in range(inputs_each)]
    return [StretchedTick(100 + n, pack(one), n) for n in range(count)]


def unhashed(told: list[StretchedTick]) -> list[StretchedTick]:
    return [entry._replace(state_hash=None) for entry in told[:-1]] + told[-1:]


def test_the_last_ticks_are_repeated(wire):
    publisher, payloads = wire
    told = ticks(6, 0)
    for end in range(1, 7):
        publisher.tick(told[:end], [Ack(1, 2, 3, 0, None)])
    message = decode(payloads()[-1], Tick)
    assert list(message.ticks()) == unhashed(told)
    assert message.acks == [Ack(1, 2, 3, 0, None)]


@pytest.mark.parametrize(("inputs_each", "repeated"), [(10, 2), (25, 2), (60, 1), (600, 1)])
def test_repeats_give_way_before_a_message_outgrows_a_datagram(wire, inputs_each, repeated):
    publisher, payloads = wire
    told = ticks(6, inputs_each)
    for end in range(1, 7):
        publisher.tick(told[:end], [])
    payload = payloads()[-1]
    assert len(payload) <= (DATAGRAM_BYTES if repeated > 1 else BATCH)
    message = decode(payload, Tick)
    assert (message.first, message.end) == (106 - repeated, 106)


def test_the_fullest_tick_with_the_longest_refusals_fits_into_one_batch(wire):
    publisher, payloads = wire
    longest = Spawn(client=2**32 - 1, x=0.1, y=0.1, vx=0.1, vy=0.1, radius=0.1, mass=0.1)
    inputs = [
        longest.model_copy(update={"client": 2**32 - 1 - number % 2, "sequence": 2**63 * (number // 2 % 2)})
        for number in range(MAX_PER_TICK)
    ]
    acks = [
        Ack(2**32 - 1, 2**64 - 1 - number, None, -(10**9), "ž" * MAX_REASON) for number in range(MAX_ACKS)
    ]
    publisher.tick([StretchedTick(2**62 - 1, pack(inputs), 1)], acks)
    (payload,) = payloads()
    assert len(payload) <= BATCH
    message = decode(payload, Tick)
    assert len(message.inputs[0]) == MAX_PER_TICK * INPUT_BYTES
    assert message.acks == acks[-len(message.acks) :]


def test_a_snapshot_goes_out_in_parts_that_make_it_again(wire):
    publisher, payloads = wire
    data = bytes(range(256)) * 1000
    publisher.snapshot(60, data)
    assembly = Assembly()
    parts = payloads()
    assert all(len(part) <= BATCH for part in parts)
    wholes = [assembly.add(decode(part, Part)) for part in parts]
    assert wholes[-1].data == data
    assert (wholes[-1].epoch, wholes[-1].tick) == (9, 60)


def test_a_snapshot_that_nobody_listens_for_is_not_made():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    session = open_session(server_configuration(listen=[endpoint], connect=[]))
    counters = Counters()
    publisher = Publisher(session, Keys("test"), epoch=9, rate=60, counters=counters)
    publisher.snapshot(60, b"state")
    assert counters.all() == {}
    heard = session.declare_subscriber(Keys("test").snapshot, zenoh.handlers.FifoChannel(10))
    publisher.snapshot(120, b"state")
    assert (counters["snapshots_out"], counters["messages_out"]) == (1, 1)
    assert decode(heard.recv().payload.to_bytes(), Part).tick == 120
    close_session(session, [*publisher.declared, heard])
