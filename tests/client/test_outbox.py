"""Inputs are repeated until the server has said what became of them, and then never again."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from kuglice.inputs import Thrust
from kuglice.protocol import MAX_INPUTS, Ack
from kuglice_client.outbox import MAX_PENDING, Outbox


def outbox(sequence: int = 0) -> Outbox:
    return Outbox(epoch=1, number=3, sequence=sequence, resend_seconds=0.1)


def ack(sequence: int | None, tick: int | None = 5, client: int = 3, early: int = 1) -> Ack:
    return Ack(client, sequence, tick, early, None if tick is not None else "no")


def test_numbers_go_on_from_where_the_server_saw_us_last():
    box = outbox(sequence=41)
    assert box.add(Thrust(x=1, y=0), 7) == Thrust(client=3, sequence=42, x=1, y=0)


def test_everything_unacknowledged_goes_along_until_it_is_answered():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7)
    assert [one.sequence for one in box.message(0.0).inputs] == [1]
    box.add(Thrust(x=2, y=0), 8)
    assert [(one.sequence, one.tick) for one in box.message(0.01).inputs] == [(1, 7), (2, 8)]
    assert box.message(0.02) is None, "nothing new, and not long ago"
    assert [one.sequence for one in box.message(0.2).inputs] == [1, 2]
    box.resolve(ack(1))
    box.resolve(ack(2, None))
    assert box.message(9.0) is None
    assert (box.accepted, box.refused) == (1, 1)


def test_who_it_is_does_not_travel_in_the_message():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7)
    assert box.message(0.0).inputs[0].act == {"kind": "thrust", "x": 1.0, "y": 0.0}


def test_an_outcome_that_is_heard_again_or_is_anothers_is_no_news():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7)
    assert box.resolve(ack(1, client=4)) is None
    assert box.resolve(ack(None)) is None
    assert box.resolve(ack(1, early=-2)).tick == 7
    assert box.resolve(ack(1)) is None
    assert (box.accepted, box.late) == (1, 1)


@given(st.integers(1, MAX_PENDING))
def test_a_message_never_holds_more_than_it_may(count):
    box = outbox()
    for tick in range(count):
        box.add(Thrust(x=1, y=0), tick)
    assert [one.sequence for one in box.message(0.0).inputs] == list(range(1, min(count, MAX_INPUTS) + 1))
    assert box.full == (count == MAX_PENDING)
