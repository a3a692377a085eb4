"""Regression: one client, or a stranger, held up the tick of all.

227 messages per second of 64 old sequence numbers each halved the server's rate: every one was looked up in lists of
all that was ever to be told again. Whoever put on `input/x/y` as fast as it could held the tick loop, which read until
nothing came any more, for half a second, and pushed the inputs of those who play out of the ring that all shared.

And an input numbered 2**64 - 1 was taken, so that all later ones of that name were too low for ever, and the next
client of that name died of a `struct.error`.
"""

from __future__ import annotations

import pytest
import zenoh

from e2e.processes import free_endpoint, until
from kuglice.errors import InputError
from kuglice.inputs import Thrust, pack
from kuglice.protocol import (
    ClientInputs,
    Keys,
    SentInput,
    client_configuration,
    close_session,
    encode,
    open_session,
    server_configuration,
)
from kuglice_server.counters import Counters
from kuglice_server.inboxes import WAITING_MESSAGES, Inboxes
from kuglice_server.intake import ANSWERS_PER_TICK, INPUTS_PER_TICK, SEQUENCE_JUMP
from server.test_intake import EPOCH, REPEAT, Desk

KEYS = Keys("small")


@pytest.fixture
def desk():
    return Desk()


def flood(desk: Desk, *sequences: int) -> None:
    """One message, in which each of these asks for the same thing."""
    sent = [SentInput(2, Thrust(x=1.0, y=0.0, sequence=sequence)) for sequence in sequences]
    payload = encode(ClientInputs(epoch=EPOCH, heard=desk.world.tick, inputs=sent))
    desk.intake.receive(KEYS.input("ana", "s1"), payload, world=desk.world)


def test_old_sequence_numbers_are_told_of_a_few_times_a_tick_however_many_are_sent(desk):
    flood(desk, 900)
    desk.step()
    for tick in range(3 * REPEAT):
        for message in range(16):
            flood(desk, *range(1 + 40 * tick + message, 33 + 40 * tick + message))
        assert len(desk.tell()) <= REPEAT * ANSWERS_PER_TICK + 1
        desk.step()
    assert desk.counters["unanswered"] > 0
    assert len(desk.intake._told) <= (REPEAT + 1) * ANSWERS_PER_TICK


def refused(desk: Desk) -> list[int | None]:
    return [ack.sequence for ack in desk.tell() if ack.refused is not None]


def test_the_same_answer_is_given_again_once_it_is_told_no_more(desk):
    flood(desk, 900)
    desk.step()
    flood(desk, 1)
    assert refused(desk) == [1]
    for _ in range(REPEAT):
        desk.step()
    assert refused(desk) == []
    flood(desk, 1)
    assert refused(desk) == [1]


def test_so_many_inputs_of_one_client_are_read_per_tick_and_the_rest_is_counted(desk):
    for _ in range(5):
        flood(desk, *range(1, 33))
    assert desk.counters["flooded"] == 5 - INPUTS_PER_TICK // 32
    desk.step()
    flood(desk, *range(1, 33))
    assert desk.counters["flooded"] == 5 - INPUTS_PER_TICK // 32


@pytest.mark.parametrize("sequence", [SEQUENCE_JUMP + 1, 2**64 - 1])
def test_a_number_far_ahead_is_refused_and_spoils_none_that_follow(desk, sequence):
    (refused,) = desk.send((sequence, 2, Thrust(x=1.0, y=0.0)))
    assert refused.tick is None
    assert f"sequence {sequence}: at most {SEQUENCE_JUMP} allowed" in refused.refused
    (ack,) = desk.send((1, 2, Thrust(x=1.0, y=0.0)))
    assert ack.refused is None
    assert desk.players.status()["ana"].sequence == 1


def test_a_number_that_no_record_can_hold_is_named():
    with pytest.raises(InputError, match="thrust 18446744073709551616 of client 0"):
        pack([Thrust(x=1.0, y=0.0).model_copy(update={"sequence": 2**64})])


@pytest.fixture
def ends():
    endpoint = free_endpoint()
    server = open_session(server_configuration(listen=[endpoint], connect=[]))
    client = open_session(client_configuration([endpoint], timeout=30.0))
    inboxes = Inboxes(server, KEYS, counters=Counters())
    yield inboxes, client
    close_session(client, [])
    close_session(server, [inboxes])


def put(client: zenoh.Session, key: str, payload: bytes) -> None:
    client.put(key, payload, congestion_control=zenoh.CongestionControl.BLOCK)


def test_only_who_plays_has_an_inbox_and_a_flood_fills_no_other(ends):
    inboxes, client = ends
    inboxes.keep([("ana", "s1"), ("bob", "s2")])
    put(client, KEYS.input("ana", "s1"), b"ana's")
    for number in range(5 * WAITING_MESSAGES):
        put(client, KEYS.input("x", "y"), b"a stranger's")
        put(client, KEYS.input("ana", "s2"), b"of another session")
        put(client, KEYS.input("bob", "s2"), b"%d" % number)
    client.delete("kuglice/small/input/*/*", congestion_control=zenoh.CongestionControl.BLOCK)
    put(client, KEYS.input("ana", "s1"), b"the end")
    heard: list[bytes | None] = []

    def all_came() -> bool:
        taken = list(inboxes.take())
        assert len(taken) <= 2 * WAITING_MESSAGES
        heard.extend(letter.payload for letter in taken if letter.key == KEYS.input("ana", "s1"))
        return b"the end" in heard

    until(all_came, what="the last of ana's messages")
    assert heard == [b"ana's", b"the end"]
    inboxes.keep([("bob", "s2")])
    put(client, KEYS.input("ana", "s1"), b"gone")
    put(client, KEYS.input("bob", "s2"), b"the end")
    until(lambda: any(letter.payload == b"the end" for letter in inboxes.take()), what="bob's message")
