"""How long the way takes is asked of a real queryable, over a session of this process, and now and then only."""

from __future__ import annotations

import itertools
import threading
import time

import pytest
import zenoh

from kuglice.processes import free_port
from kuglice.protocol import (
    Keys,
    Refusal,
    TickRange,
    decode,
    encode,
    open_session,
    server_configuration,
)
from kuglice_client.link import Link
from kuglice_client.pinging import EVERY_SECONDS, FIRST, FIRST_EVERY_SECONDS, Pinging

EPOCH = 7
KEYS = Keys("asked")
DEADLINE_SECONDS = 20.0


class Asked:
    """A server that knows one answer, counts questions and holds them back until released."""

    def __init__(self, endpoint: str, *, refuse: bool) -> None:
        self.session = open_session(server_configuration(listen=[endpoint], connect=[]))
        self.questions: list[TickRange] = []
        self.release = threading.Event()
        self._refuse = refuse
        self._queryable = self.session.declare_queryable(KEYS.history, self._answer)

    def _answer(self, query: zenoh.Query) -> None:
        self.questions.append(decode(query.payload.to_bytes(), TickRange))
        with query:
            self.release.wait(DEADLINE_SECONDS)
            if self._refuse:
                query.reply_err(encode(Refusal(epoch=EPOCH, reason="not kept any more")))
            else:
                query.reply(KEYS.history, b"anything")


@pytest.fixture(params=[False, True], ids=["answered", "refused"])
def asked(request):
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    server = Asked(endpoint, refuse=request.param)
    link = Link((endpoint,), deadline=time.monotonic() + DEADLINE_SECONDS, stop=threading.Event())
    yield server, link
    server.release.set()
    link.close(5.0)
    server.session.close()


def test_a_yes_takes_as_long_as_a_no_and_only_one_question_is_under_way(asked):
    server, link = asked
    pinging = Pinging(link, KEYS, epoch=EPOCH, who=None, now=100.0)
    assert pinging.turn(100.0 + EVERY_SECONDS, -1) is None, "there is no tick to ask about yet"
    began = 100.0 + EVERY_SECONDS
    assert pinging.turn(began, 5) is None
    until = time.monotonic() + DEADLINE_SECONDS
    while not server.questions and time.monotonic() < until:
        assert pinging.turn(began + 0.5, 6) is None
        time.sleep(0.002)
    server.release.set()
    trip = None
    while trip is None and time.monotonic() < until:
        trip = pinging.turn(began + 0.75, 7)
        time.sleep(0.002)
    assert trip == pytest.approx(0.75)
    assert server.questions == [TickRange(epoch=EPOCH, first=5, end=6)]


def test_the_first_questions_come_in_quick_succession_and_the_others_now_and_then(asked):
    server, link = asked
    server.release.set()
    pinging = Pinging(link, KEYS, epoch=EPOCH, who=None, now=0.0)
    asked_at, now, until = [], 0.0, time.monotonic() + DEADLINE_SECONDS
    while len(asked_at) < FIRST + 2 and time.monotonic() < until:
        if pinging.turn(now, 5) is not None:
            # Of virtual time none goes by until there is an answer: it was asked just now.
            asked_at.append(now)
            now += 0.51 * FIRST_EVERY_SECONDS
        elif pinging.idle:
            now += 0.51 * FIRST_EVERY_SECONDS
        else:
            time.sleep(0.002)
    waits = [late - soon for soon, late in itertools.pairwise(asked_at)]
    assert waits[: FIRST - 1] == pytest.approx([FIRST_EVERY_SECONDS] * (FIRST - 1), rel=0.03)
    assert waits[FIRST - 1 :] == pytest.approx([EVERY_SECONDS] * 2, rel=0.03)


def test_silence_measures_nothing_and_the_next_question_comes_in_its_time(asked):
    server, link = asked
    server._queryable.undeclare()
    pinging = Pinging(link, KEYS, epoch=EPOCH, who=None, now=0.0)
    # Asked and given up, again and again: never does it say how long that took.
    until = time.monotonic() + 1.0
    now = 0.0
    while time.monotonic() < until:
        now += EVERY_SECONDS
        assert pinging.turn(now, 5) is None
        time.sleep(0.002)
