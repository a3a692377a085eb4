"""Regression: a view opened its link anew every ten seconds where ticks are slow.

It took a stream that brings nothing for two seconds, while the server answers, for one that is broken. But a server
says nothing between two ticks, and these may be seconds apart, because it was asked for or because it cannot do better.
The view's time is made up here, the links and the server are real.
"""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest

import kuglice as kg
from e2e.processes import until
from kuglice_client.view import View, ViewSettings
from kuglice_client.view.partial_replica import SILENCE_SECONDS
from kuglice_server import Server, ServerSettings

WORLD = "slow"
STEP_SECONDS = 0.05


class Looking:
    """A view whose time passes as it is told to."""

    def __init__(self, view: View) -> None:
        self.view = view
        self._now = time.monotonic()

    def passes(self, seconds: float) -> None:
        """In short turns, each of which leaves the network the time of a short rest."""
        for _ in range(round(seconds / STEP_SECONDS)):
            self._now += STEP_SECONDS
            self.view.turn(self._now)
            time.sleep(0.002)

    @property
    def questions(self) -> int:
        return self.view.link.traffic.received["joining"]


@pytest.fixture
def look(endpoint) -> Iterator:
    opened: list = []

    def make(rate: float) -> Looking:
        server = Server(kg.scenes.arena(), ServerSettings(world=WORLD, listen=[endpoint], rate=rate))
        opened.append(server)
        view = View(ViewSettings((0.0, 0.0, 10.0, 10.0), connect=(endpoint,), wait=30.0))
        opened.append(view)
        return Looking(view)

    yield make
    for one in reversed(opened):
        one.close()


def test_a_server_that_stands_still_is_asked_but_its_link_is_left_alone(look):
    looking = look(60.0)
    before = looking.questions
    looking.passes(60.0)
    until(lambda: looking.passes(1.0) or looking.questions > before, what="an answer")
    assert looking.view.renewal.renewals == 0


def test_a_server_of_few_ticks_is_not_even_asked(look):
    looking = look(0.1)
    before = looking.questions
    looking.passes(25.0)
    assert looking.questions == before
    assert looking.view.renewal.renewals == 0


def test_one_that_goes_on_and_is_not_heard_has_its_link_opened_anew(look):
    looking = look(60.0)
    replica = looking.view.replica
    later = replica.about.model_copy(update={"tick": replica.about.tick + round(60 * SILENCE_SECONDS)})
    assert not replica.overdue(replica.about)
    assert not replica.overdue(later)
    assert replica.overdue(later.model_copy(update={"tick": later.tick + 1}))
