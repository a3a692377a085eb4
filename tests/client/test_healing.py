"""What is asked for when ticks are missing, of an authority that answers when the test says so."""

from __future__ import annotations

import pytest

from client.conftest import EPOCH
from kuglice.protocol import Keys, SnapshotRequest, TickRange, Whole, encode
from kuglice_client.follow import Follower
from kuglice_client.healing import LEAP_SECONDS, TICKS_IN_SILENCE, Healing
from kuglice_client.reconcile import Reconciler

STATE_SECONDS = 2.0
CHEAP, DEAR = 1e-6, 0.1
"""Seconds that a tick takes."""


class Question:
    refused = False

    def __init__(self, request) -> None:
        self.request = request
        self.answer: Whole | None = None

    def poll_whole(self) -> Whole | None:
        return self.answer


class Link:
    def __init__(self) -> None:
        self.session = object()
        self.asked: list[Question] = []

    def ask(self, key, request, *, timeout):
        self.asked.append(Question(request))
        return self.asked[-1]


class Patient:
    """One who follows and misses something; `turn` after `turn`, far enough apart for another question."""

    def __init__(self, authority, *, state_seconds: float = STATE_SECONDS) -> None:
        self.authority = authority
        self.link = Link()
        self.follower = Follower(authority.world.clone())
        reconciler = Reconciler(self.follower, snapshot_every=None)
        self.healing = Healing(
            self.link,
            Keys("small"),
            epoch=EPOCH,
            follower=self.follower,
            reconciler=reconciler,
            state_seconds=state_seconds,
        )
        self._now = 100.0

    def miss(self, ticks: int) -> None:
        for _ in range(ticks):
            self.authority.step()

    def hear(self) -> None:
        """The newest tick."""
        self.authority.step()
        self.follower.take(self.authority.message())

    def turn(self, *, step_seconds: float, silent: bool = False) -> bool:
        self._now += 1.0
        missing = self.authority.world.tick - self.follower.world.tick
        replaced = self.healing.turn(self._now, missing=missing, step_seconds=step_seconds, silent=silent)
        list(self.follower.advance())
        return replaced

    def answer(self, kind: type = TickRange) -> None:
        """The newest question of that kind."""
        question = next(one for one in reversed(self.link.asked) if type(one.request) is kind)
        if isinstance(question.request, TickRange):
            told = self.authority.history(question.request.first, question.request.end)
            question.answer = Whole("history", EPOCH, told.first, encode(told))
        else:
            world = self.authority.world
            question.answer = Whole("snapshot", EPOCH, world.tick, world.snapshot())

    @property
    def requests(self) -> list[type]:
        return [type(question.request) for question in self.link.asked]

    @property
    def well(self) -> bool:
        return self.follower.world.snapshot() == self.authority.world.snapshot()


@pytest.fixture
def patient(authority):
    return Patient(authority)


@pytest.mark.parametrize(("ticks", "step_seconds"), [(300, CHEAP), (STATE_SECONDS / DEAR - 4, DEAR)])
def test_ticks_that_are_stepped_through_soon_are_asked_for_and_replace_no_state(patient, ticks, step_seconds):
    patient.miss(round(ticks))
    patient.hear()
    patient.turn(step_seconds=step_seconds)
    patient.answer()
    assert not patient.turn(step_seconds=step_seconds)
    assert patient.requests == [TickRange]
    assert patient.well


def test_a_state_that_comes_sooner_than_they_are_stepped_through_is_taken(patient):
    patient.miss(round(STATE_SECONDS / DEAR) + 1)
    patient.hear()
    patient.turn(step_seconds=DEAR)
    patient.answer(SnapshotRequest)
    patient.hear()
    assert patient.turn(step_seconds=DEAR)
    assert patient.requests == [TickRange, SnapshotRequest], "in one turn, and the ticks first"
    assert patient.healing.gaps_skipped == 1
    assert patient.well, "with what the stream told meanwhile"
    patient.answer(TickRange)
    assert not patient.turn(step_seconds=DEAR)
    assert patient.well, "whatever comes later"


def test_ticks_that_are_stepped_through_before_the_state_comes_replace_it(patient):
    patient.miss(round(STATE_SECONDS / DEAR) + 1)
    patient.hear()
    patient.turn(step_seconds=DEAR)
    patient.answer(SnapshotRequest)
    late, patient.link.asked[-1].answer = patient.link.asked[-1].answer, None
    patient.answer(TickRange)
    assert not patient.turn(step_seconds=DEAR)
    assert patient.well
    patient.link.asked[-1].answer = late
    patient.hear()
    assert not patient.turn(step_seconds=DEAR)
    assert patient.healing.gaps_skipped == 0
    assert patient.requests == [TickRange, SnapshotRequest]
    assert patient.well


def test_a_state_under_way_is_waited_for_where_the_history_does_not_reach_back(patient):
    patient.miss(round(STATE_SECONDS / DEAR) + 1)
    patient.hear()
    patient.turn(step_seconds=DEAR)
    del patient.authority.ticks[: patient.follower.world.tick + 3]
    patient.answer(TickRange)
    for _ in range(3):
        assert not patient.turn(step_seconds=DEAR)
    patient.answer(SnapshotRequest)
    assert patient.turn(step_seconds=DEAR)
    assert patient.requests == [TickRange, SnapshotRequest], "and no other one is asked for meanwhile"
    assert patient.well


def test_all_holes_of_the_stream_are_asked_for_at_once(patient):
    for missed in (3, 1, 5):
        patient.miss(missed)
        patient.hear()
        patient.hear()
    patient.turn(step_seconds=CHEAP)
    patient.answer()
    patient.turn(step_seconds=CHEAP)
    patient.turn(step_seconds=CHEAP)
    assert patient.requests == [TickRange]
    first, end = patient.link.asked[0].request.first, patient.link.asked[0].request.end
    assert end - first == 3 + 2 + 1 + 2 + 5, "and not what came behind the last"
    assert patient.well


def test_holes_far_from_each_other_are_asked_for_one_after_the_other(patient):
    patient.miss(1)
    for _ in range(TICKS_IN_SILENCE):
        patient.hear()
    patient.miss(1)
    patient.hear()
    patient.turn(step_seconds=CHEAP)
    patient.answer()
    patient.turn(step_seconds=CHEAP)
    patient.turn(step_seconds=CHEAP)
    patient.answer()
    patient.turn(step_seconds=CHEAP)
    assert patient.requests == [TickRange, TickRange]
    assert patient.well


def test_what_was_asked_over_a_new_link_is_waited_for_when_the_stream_is_heard_again(patient):
    patient.turn(step_seconds=CHEAP, silent=True)
    patient.miss(20)
    patient.link.session = object()
    patient.turn(step_seconds=CHEAP, silent=True)
    patient.hear()
    patient.turn(step_seconds=CHEAP, silent=False)
    patient.answer()
    patient.turn(step_seconds=CHEAP, silent=False)
    assert patient.requests == [TickRange, TickRange], "one into the void, one over the new link"
    assert patient.well


def test_a_question_of_an_old_link_is_asked_again_over_the_new_one(patient):
    patient.turn(step_seconds=CHEAP, silent=True)
    patient.turn(step_seconds=CHEAP, silent=True)
    assert patient.requests == [TickRange]
    patient.miss(20)
    patient.link.session = object()
    patient.turn(step_seconds=CHEAP, silent=True)
    patient.answer()
    patient.turn(step_seconds=CHEAP, silent=True)
    assert patient.requests == [TickRange, TickRange]
    assert patient.well


def test_over_a_new_link_the_state_is_asked_for_before_the_stream_says_anything(patient):
    patient.turn(step_seconds=DEAR, silent=True)
    patient.miss(round(STATE_SECONDS / DEAR) + 1)
    patient.turn(step_seconds=DEAR, silent=True)
    assert patient.requests == [TickRange], "into the void nothing large is asked for"
    patient.link.session = object()
    patient.turn(step_seconds=DEAR, silent=True)
    patient.answer(SnapshotRequest)
    assert patient.turn(step_seconds=DEAR, silent=True)
    assert patient.requests == [TickRange, TickRange, SnapshotRequest], "and the ticks before it"
    assert patient.well


def test_half_a_second_is_not_worth_leaving_ticks_out(authority):
    patient = Patient(authority, state_seconds=0.01)
    patient.miss(round(LEAP_SECONDS / DEAR) - 2)
    patient.hear()
    patient.turn(step_seconds=DEAR)
    assert patient.requests == [TickRange]
