"""Regression: a view froze without a word where its server was restarted as one that steps to other bits.

What it was told of other runs went into a log that nobody reads; a full client says so and ends.
"""

from __future__ import annotations

import re
import signal
from collections.abc import Callable, Iterator

import msgpack
import pytest
import zenoh

import kuglice as kg
from e2e.processes import free_endpoint, until
from kuglice import _core
from kuglice.errors import JoinError
from kuglice.protocol import (
    PROTOCOL_VERSION,
    Keys,
    ViewAbout,
    close_session,
    encode,
    open_session,
    server_configuration,
)
from kuglice_client.view import View, ViewSettings
from kuglice_server import Server, ServerSettings

WORLD = "small"


def about() -> ViewAbout:
    """Of a run that comes later than any other."""
    with Server(kg.scenes.arena(), ServerSettings(world=WORLD, listen=[free_endpoint()])) as server:
        return server.view_about()


def other_steps() -> bytes:
    return encode(about().model_copy(update={"step_version": _core.STEP_VERSION + 1}))


def other_messages() -> bytes:
    return msgpack.packb({**msgpack.unpackb(encode(about())), "v": PROTOCOL_VERSION + 1})


STEPS = rf"step version {_core.STEP_VERSION + 1} of the server .* this view has {_core.STEP_VERSION}"
MESSAGES = rf"protocol version {PROTOCOL_VERSION + 1}, this side speaks {PROTOCOL_VERSION}"
OTHERS = pytest.mark.parametrize("other", [(other_steps, STEPS), (other_messages, MESSAGES)])


@pytest.fixture
def served(endpoint) -> Iterator[Callable[[bytes], None]]:
    """Something at the endpoint that says that about itself, and nothing else."""
    opened: list[tuple[zenoh.Session, zenoh.Queryable]] = []

    def serve(reply: bytes) -> None:
        session = open_session(server_configuration(listen=[endpoint], connect=[]))
        key = Keys(WORLD).view

        def answer(query: zenoh.Query) -> None:
            with query:
                query.reply(key, reply)

        opened.append((session, session.declare_queryable(key, zenoh.handlers.Callback(answer))))

    yield serve
    for session, queryable in opened:
        close_session(session, [queryable])


@OTHERS
def test_a_view_of_a_server_that_became_another_says_so_and_ends(start, endpoint, server, served, other):
    reply, words = other
    view = start("view", "0,0,10,10", "--connect", endpoint, "--wait", 30)
    until(lambda: "looking at world" in view.err, what="it looks")
    server.signal(signal.SIGINT)
    server.wait()
    served(reply())
    assert view.wait() == 2
    assert re.search(words, view.err)


@OTHERS
def test_a_view_that_comes_to_such_a_server_does_not_wait_for_it_to_change(endpoint, served, other):
    reply, words = other
    served(reply())
    settings = ViewSettings((0.0, 0.0, 10.0, 10.0), connect=(endpoint,), world=WORLD, wait=3600.0)
    with pytest.raises(JoinError, match=words):
        View(settings)
