"""Regression: who asked something quick waited behind who asked something slow.

All questions under one key were answered one after the other. One who asked whether it plays, under a name that was
kept for another session, held up everybody's `status` for 0.1 s each time, and it asked again every 0.03 s. One who
asked for the state of now held up everybody's `history` until the next tick had made it: where ticks are slow, every
ping took 0.25 s longer than the way, and clients ran ahead by as much.

Here nothing is ever settled and no tick is ever made unless the test says so, and nobody gives up waiting.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest
import zenoh

from e2e.processes import free_endpoint, until
from kuglice.protocol import (
    ANY_EPOCH,
    Admission,
    ArrivalRequest,
    Keys,
    Message,
    Part,
    Refusal,
    SnapshotRequest,
    Status,
    StretchedTick,
    TickRange,
    client_configuration,
    close_session,
    decode,
    encode,
    open_session,
    server_configuration,
)
from kuglice_server import arrivals, history
from kuglice_server.answer import Answers
from kuglice_server.history import History, KeptSnapshot

EPOCH = 9
KEYS = Keys("test")
FOR_EVER = 3600.0


def status() -> Status:
    return Status(
        epoch=EPOCH,
        world="test",
        tick=0,
        rate=60.0,
        balls=0,
        clients={},
        counters={},
        seconds_lost=0.0,
        worst_lateness=0.0,
    )


class _About:
    hash_every = 1


@dataclass
class Desk:
    """Answers over a real link, and who asks there."""

    answers: Answers
    history: History
    asker: zenoh.Session
    settled: set[tuple[str, str]] = field(default_factory=set)

    def ask(self, key: str, request: Message | None):
        """Ask; called without a number, whether there is an answer by now."""
        handler = self.asker.get(
            key,
            zenoh.handlers.FifoChannel(100),
            timeout=FOR_EVER,
            payload=None if request is None else encode(request),
        )
        found: list[Message] = []

        def answer(*, waited_for: bool = True):
            def came() -> bool:
                reply = None if found else handler.try_recv()
                if reply is not None:
                    data = reply.ok.payload if reply.ok is not None else reply.err.payload
                    found.append(decode(data.to_bytes(), Status, Admission, Part, Refusal))
                return bool(found)

            if waited_for:
                until(came, what=f"an answer under {key}")
            else:
                came()
            return found[0] if found else None

        return answer

    def ask_as(self, name: str):
        return self.ask(KEYS.status, ArrivalRequest(epoch=ANY_EPOCH, name=name, session="session"))


@pytest.fixture
def desk(monkeypatch):
    monkeypatch.setattr(arrivals, "SETTLE_SECONDS", FOR_EVER)
    monkeypatch.setattr(history, "FRESH_SECONDS", FOR_EVER)
    endpoint = free_endpoint()
    session = open_session(server_configuration(listen=[endpoint], connect=[]))
    asker = open_session(client_configuration([endpoint], timeout=30.0))
    kept = History(span=1000)
    kept.add_snapshot(KeptSnapshot(0, b"old"))
    for tick in range(100):
        kept.add_tick(StretchedTick(tick, b"", tick))
    settled: set[tuple[str, str]] = set()
    answers = Answers(
        session,
        KEYS,
        epoch=EPOCH,
        hash_every=1,
        about=_About,
        view=_About,
        status=status,
        settled=lambda *who: who in settled,
        admission=lambda *who: Admission(epoch=EPOCH, number=1, sequence=0, refused=None, kept=False),
        history=kept,
    )
    yield Desk(answers, kept, asker, settled)
    kept.add_fresh(KeptSnapshot(100, b"new"))
    close_session(asker, [])
    assert close_session(session, answers.declared, timeout=30.0), "whoever still waits holds nobody up"


def test_nobody_waits_behind_names_that_cannot_be_settled(desk):
    in_vain = [desk.ask_as(f"in-vain-{number}") for number in range(20)]
    assert isinstance(desk.ask(KEYS.status, None)(), Status)
    desk.settled.add(("ana", "session"))
    assert isinstance(desk.ask_as("ana")(), Admission)
    assert not any(answer(waited_for=False) for answer in in_vain)


def test_who_waits_is_answered_by_the_tick_that_settles_it(desk):
    ana, bob = desk.ask_as("ana"), desk.ask_as("bob")
    desk.ask(KEYS.status, None)()
    desk.settled.add(("bob", "session"))
    desk.answers.ticked()
    assert isinstance(bob(), Admission)
    assert ana(waited_for=False) is None


def test_pings_and_history_do_not_wait_for_the_state_of_now(desk):
    states = [desk.ask(KEYS.history, SnapshotRequest(epoch=ANY_EPOCH, at=None)) for _ in range(3)]
    ticks = desk.ask(KEYS.history, TickRange(epoch=EPOCH, first=99, end=100))
    assert ticks().of == "history"
    assert not any(state(waited_for=False) for state in states)
    desk.history.add_fresh(KeptSnapshot(100, b"new"))
    assert [(state().of, state().tick) for state in states] == [("snapshot", 100)] * 3


def test_what_cannot_be_asked_is_refused_at_once(desk):
    assert isinstance(desk.ask(KEYS.history, None)(), Refusal)
    assert isinstance(desk.ask(KEYS.history, TickRange(epoch=EPOCH + 1, first=0, end=1))(), Refusal)
    assert isinstance(desk.ask(KEYS.status, TickRange(epoch=EPOCH, first=0, end=1))(), Refusal)


def test_more_than_may_wait_are_answered_at_once(desk, monkeypatch):
    monkeypatch.setattr(arrivals, "MOST_WAITING", 1)
    first, second = desk.ask_as("first"), desk.ask_as("second")
    assert isinstance(second(), Admission)
    assert first(waited_for=False) is None
