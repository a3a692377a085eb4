"""When a link is opened anew, in virtual time: a few times for datagrams, again and again for ticks."""

from __future__ import annotations

import pytest

from kuglice_client.link.renewal import AGAIN_SECONDS, DATAGRAM_TRIES, Renewal

STEP = 0.05


class Datagrams:
    """As DatagramWatch says it: `missing` once it has looked, which it does some time after each renewal."""

    def __init__(self) -> None:
        self.missing = False
        self.up = False

    def turn(self, now: float) -> None:
        pass

    def renewed(self) -> None:
        self.missing = False


class Link:
    """Opens another session in no time, and counts."""

    def __init__(self) -> None:
        self.kinds = ["tcp"]
        self.owes_datagrams = False
        self.begun = 0
        self._opening = False
        self._opening_owes = False

    def begin_renewal(self) -> None:
        self._opening, self._opening_owes = True, False
        self.begun += 1

    def renew_if_lost(self) -> None:
        if not self.kinds:
            self.begin_renewal()
            self._opening_owes = True

    def renewed(self) -> bool:
        opened, self._opening = self._opening, False
        if opened:
            self.kinds, self.owes_datagrams = ["tcp"], self._opening_owes
        return opened


@pytest.fixture
def datagrams():
    return Datagrams()


class Time:
    """Turns a renewal for so many seconds, from where it was."""

    def __init__(self, link: Link, datagrams: Datagrams) -> None:
        self.renewal = Renewal(link, datagrams)
        self._turns = 0

    def passes(
        self, seconds: float, *, silent: bool = False, answered: bool = False, busy: bool = False
    ) -> None:
        for _ in range(round(seconds / STEP)):
            self._turns += 1
            self.renewal.turn(100.0 + self._turns * STEP, silent=silent, answered=answered, busy=busy)


def test_a_link_that_is_well_is_left_alone(datagrams):
    link = Link()
    datagrams.up = True
    Time(link, datagrams).passes(60.0)
    assert link.begun == 0


def test_datagrams_that_do_not_come_up_are_tried_a_few_times_and_then_done_without(datagrams):
    link = Link()
    time = Time(link, datagrams)
    for _ in range(10):
        datagrams.missing = True
        time.passes(5.0)
    assert link.begun == time.renewal.renewals == DATAGRAM_TRIES


def test_datagrams_that_came_up_are_worth_as_many_tries_when_they_die_again(datagrams):
    link = Link()
    time = Time(link, datagrams)
    for _ in range(10):
        datagrams.missing = True
        time.passes(5.0)
    datagrams.missing, datagrams.up = False, True
    time.passes(1.0)
    datagrams.missing, datagrams.up = True, False
    time.passes(5.0)
    assert link.begun == DATAGRAM_TRIES + 1


def test_a_server_that_answers_and_sends_no_ticks_is_connected_to_again_now_and_then(datagrams):
    link = Link()
    Time(link, datagrams).passes(3 * AGAIN_SECONDS + 1.0, silent=True, answered=True)
    assert link.begun == 3


def test_a_session_is_opened_anew_as_soon_as_it_has_no_link_any_more(datagrams):
    link = Link()
    link.kinds = []
    Time(link, datagrams).passes(1.0, silent=True)
    assert link.begun == 1
    assert link.kinds == ["tcp"]


def test_datagrams_that_are_owed_are_asked_for_once_nothing_else_is_waited_for(datagrams):
    link = Link()
    time = Time(link, datagrams)
    link.kinds = []
    time.passes(1.0, silent=True)
    time.passes(1.0, busy=True)
    assert link.begun == 1, "a session that is replaced loses what is under way"
    time.passes(1.0)
    assert link.begun == time.renewal.renewals == 2
    assert not link.owes_datagrams
