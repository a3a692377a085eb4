"""Inputs are repeated until the server has said what became of them, and then never again."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.inputs import Thrust
from kuglice.protocol import MAX_INPUTS, Ack
from kuglice_client.outbox import COPIES, MAX_PENDING, REPORT_SECONDS, Outbox

TICK, OVERDUE = 1 / 64, 1 / 4


def outbox(sequence: int = 0) -> Outbox:
    return Outbox(epoch=1, number=3, sequence=sequence, tick_seconds=TICK, resend_seconds=OVERDUE)


def ack(sequence: int | None, tick: int | None = 5, client: int = 3, early: int = 1) -> Ack:
    return Ack(client, sequence, tick, early, None if tick is not None else "no")


def test_numbers_go_on_from_where_the_server_saw_us_last():
    box = outbox(sequence=41)
    assert box.add(Thrust(x=1, y=0), 7, lead=2.0, made=0.0) == Thrust(client=3, sequence=42, x=1, y=0)


def sequences(message) -> list[int]:
    return [] if message is None else [one.given.sequence for one in message.inputs]


def test_everything_unacknowledged_goes_along_until_it_is_answered():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7, lead=2.0, made=0.0)
    assert sequences(box.message(10.0, 5)) == [1]
    box.add(Thrust(x=2, y=0), 8, lead=2.0, made=0.0)
    message = box.message(10.001, 6)
    assert [(one.given.sequence, one.tick) for one in message.inputs] == [(1, 7), (2, 8)]
    assert message.heard == 6
    box.resolve(ack(1))
    box.resolve(ack(2, None))
    assert box.message(10.05, 6) is None
    assert (box.accepted, box.refused) == (1, 1)


def test_a_new_input_is_in_the_messages_of_the_next_ticks_too_and_then_only_when_overdue():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7, lead=2.0, made=0.0)
    # Powers of two, so that times are exact.
    sent = [at for at in range(1024) if box.message(16.0 + at / 1024, 0) is not None]
    assert sent[:COPIES] == [16 * copy for copy in range(COPIES)]
    apart = [later - earlier for earlier, later in zip(sent[COPIES - 1 :], sent[COPIES:], strict=False)]
    assert set(apart) == {256}


def test_who_has_nothing_to_say_reports_what_was_heard_now_and_then():
    box = outbox()
    reports = [box.message(10.0 + tick * TICK, tick) for tick in range(1, 100)]
    told = [message for message in reports if message is not None]
    assert all(message.inputs == [] for message in told)
    assert len(told) == pytest.approx(99 * TICK / REPORT_SECONDS, abs=2)
    assert [message.heard for message in told] == sorted({message.heard for message in told})
    assert box.message(99.0, told[-1].heard) is None or told[-1].heard < 99


def test_an_input_that_acts_without_a_word_about_how_early_is_late_if_it_acts_late():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7, lead=2.0, made=0.0)
    box.add(Thrust(x=2, y=0), 8, lead=2.0, made=0.0)
    box.resolve(Ack(3, 1, 7, None, None))
    box.resolve(Ack(3, 2, 9, None, None))
    assert box.late == 1


def test_an_outcome_that_is_heard_again_or_is_anothers_is_no_news():
    box = outbox()
    box.add(Thrust(x=1, y=0), 7, lead=2.0, made=0.0)
    assert box.resolve(ack(1, client=4)) is None
    assert box.resolve(ack(None)) is None
    assert box.resolve(ack(1, early=-2)).tick == 7
    assert box.resolve(ack(1)) is None
    assert (box.accepted, box.late) == (1, 1)


@given(st.integers(1, MAX_PENDING))
def test_a_message_never_holds_more_than_it_may(count):
    box = outbox()
    for tick in range(count):
        box.add(Thrust(x=1, y=0), tick, lead=2.0, made=0.0)
    assert sequences(box.message(0.0, 0)) == list(range(1, min(count, MAX_INPUTS) + 1))
    assert box.full == (count == MAX_PENDING)
