"""What is published unasked fits into one batch, and always tells the newest tick."""

from __future__ import annotations

import socket
from collections import Counter

import pytest
import zenoh

from kuglice._core import INPUT_BYTES
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
from kuglice_server.publish import Publisher

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
    publisher = Publisher(session, keys, epoch=9, counters=Counter())

    def payloads() -> list[bytes]:
        found = []
        while (sample := heard.try_recv()) is not None:
            found.append(sample.payload.to_bytes())
        return found

    yield publisher, payloads
    close_session(session, [*publisher.declared, heard])


def ticks(count: int, inputs_each: int) -> list[StretchedTick]:
    return [StretchedTick(100 + n, b"x" * (INPUT_BYTES * inputs_each), n) for n in range(count)]


def test_the_last_ticks_are_repeated(wire):
    publisher, payloads = wire
    told = ticks(6, 2)
    publisher.tick(told, [Ack(1, 2, 3, 0, None)])
    (payload,) = payloads()
    message = decode(payload, Tick)
    assert list(message.ticks()) == told
    assert message.acks == [Ack(1, 2, 3, 0, None)]


@pytest.mark.parametrize(("inputs_each", "repeated"), [(100, 6), (200, 4), (400, 2), (800, 1)])
def test_repeats_give_way_before_a_message_outgrows_a_batch(wire, inputs_each, repeated):
    publisher, payloads = wire
    publisher.tick(ticks(6, inputs_each), [])
    (payload,) = payloads()
    assert len(payload) <= BATCH
    message = decode(payload, Tick)
    assert (message.first, message.end) == (106 - repeated, 106)


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
