"""Regression: `--wait 2` waited for half a minute where a server told of itself and never sent its state.

The questions who serves here and who may play were bounded by what was left to wait; the state was waited for in its
own 30 s, whatever that was, and `Client.turn` with it where a server was started again. The error did not say that it
was the wait that was over, either.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import partial

import pytest
import zenoh

from e2e.processes import free_endpoint
from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import (
    Admission,
    ArrivalRequest,
    Keys,
    StretchedTick,
    Tick,
    close_session,
    compress,
    decode,
    encode,
    open_session,
    server_configuration,
    split,
)
from kuglice_client import Client, ClientSettings
from kuglice_client.link import NotYetError, Waiting
from kuglice_client.view import View, ViewSettings
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena

WORLD = "small"
KEYS = Keys(WORLD)
QUESTIONS = {"about": KEYS.about, "status": KEYS.status, "history": KEYS.history, "view": KEYS.view}
WAIT_SECONDS = 2.0

# What the client may wait for: opening its link, joining, and the answer to its goodbye. Far below the 30 s it was,
# and far above what it takes.
pytestmark = pytest.mark.timeout(25)


@pytest.fixture
def silent_on(endpoint) -> Iterator[Callable[[str], Callable[[], None]]]:
    """Serves the truth about a world, but for one question, which it takes and keeps; gives what tells of a tick."""
    with ExitStack() as served:

        def serve(unanswered: str) -> Callable[[], None]:
            true = served.enter_context(
                Server(small_arena(), ServerSettings(world=WORLD, listen=(free_endpoint(),)))
            )
            session = open_session(server_configuration(listen=[endpoint], connect=[]))
            kept: list[zenoh.Query] = []

            def answer(name: str, query: zenoh.Query) -> None:
                if name == unanswered:
                    kept.append(query)
                    return
                with query:
                    for reply in told(true, name, query):
                        query.reply(QUESTIONS[name], reply)

            queryables = [
                session.declare_queryable(key, zenoh.handlers.Callback(partial(answer, name)))
                for name, key in QUESTIONS.items()
            ]
            served.callback(kept.clear)
            served.callback(close_session, session, queryables)
            tick = encode(Tick.of(true.epoch, [StretchedTick(0, b"", 0)]))
            return partial(session.put, KEYS.tick, tick)

        yield serve


def told(true: Server, name: str, query: zenoh.Query) -> Iterator[bytes]:
    if name == "about":
        about = true.about()
        for part in split(compress(encode(about)), of="about", epoch=about.epoch, tick=about.tick):
            yield encode(part)
    elif name == "status" and query.payload is None:
        yield encode(true.status())
    elif name == "status":
        decode(query.payload, ArrivalRequest)
        yield encode(Admission(epoch=true.epoch, number=1, sequence=0, refused=None, kept=False))


def settings(endpoint: str, **others: object) -> ClientSettings:
    return ClientSettings(connect=(endpoint,), world=WORLD, name="ana", wait=WAIT_SECONDS, **others)


@pytest.mark.parametrize("unanswered", ["about", "status", "history"])
def test_what_is_not_answered_is_waited_for_as_long_as_was_said(endpoint, silent_on, unanswered):
    silent_on(unanswered)
    words = rf"{QUESTIONS[unanswered]}\b.*; not joined within 2 s \(--wait\)$"
    with pytest.raises(JoinError, match=words):
        Client(settings(endpoint))


def test_a_view_is_bounded_likewise(endpoint, silent_on):
    silent_on("view")
    looking = ViewSettings((0.0, 0.0, 10.0, 10.0), connect=(endpoint,), world=WORLD, wait=WAIT_SECONDS)
    with pytest.raises(JoinError, match=rf"{KEYS.view}\b.*; not joined within 2 s \(--wait\)$"):
        View(looking)


@pytest.mark.timeout(120)
def test_a_command_ends_with_status_2_and_says_what_did_not_come(start, endpoint, silent_on):
    silent_on("history")
    client = start("client", "--connect", endpoint, "--wait", WAIT_SECONDS)
    assert client.wait() == 2
    assert f"{KEYS.history}: " in client.err
    assert client.err.endswith("; not joined within 2 s (--wait)\n")


@pytest.mark.timeout(120)
def test_joining_again_is_bounded_likewise(start, scene, endpoint, silent_on):
    before = start("server", scene, "--listen", endpoint)
    # Joining a true one may take its time.
    joining = ClientSettings(connect=(endpoint,), world=WORLD, name="ana", wait=60.0)
    with Client(joining) as client:
        client.settings = settings(endpoint)
        before.kill()
        tell = silent_on("history")
        with pytest.raises(JoinError, match=rf"{KEYS.history}\b.*; not joined within 2 s \(--wait\)$"):
            client.run(seconds=60.0, each_frame=lambda *_: tell())


class Reached:
    """A link that is there and needs no renewal."""

    endpoints = "here"

    def renewed(self) -> bool:
        return True


def test_the_reason_told_is_one_that_had_time_to_be_another():
    """An attempt that the bound cuts short is not answered either, which is no reason."""
    waiting = Waiting(Reached(), began=time.monotonic(), wait=1.0, stop=threading.Event())

    def attempt() -> None:
        late = waiting.answer_seconds() < 0.4
        raise NotYetError("silence" if late else "the name is taken")

    with pytest.raises(JoinError, match=r"^the name is taken; not joined within 1 s \(--wait\)$"):
        waiting.until_done(attempt)


@pytest.mark.parametrize("wait", [-1.0, float("nan")])
def test_a_wait_that_is_none_is_refused(wait):
    with pytest.raises(ProtocolError, match=f"wait {wait:g}: must be at least 0 seconds"):
        ClientSettings(wait=wait)
    with pytest.raises(ProtocolError, match=f"wait {wait:g}: must be at least 0 seconds"):
        ViewSettings((0.0, 0.0, 1.0, 1.0), wait=wait)
