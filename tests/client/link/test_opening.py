"""A session is opened by whichever try is the first; what opens later is closed again."""

from __future__ import annotations

import socket
import threading
import time

import pytest

from kuglice.errors import JoinError
from kuglice.processes import free_port
from kuglice.protocol import (
    client_configuration,
    close_session,
    open_links,
    open_session,
    server_configuration,
)
from kuglice_client.link.opening import STAGGER_SECONDS, TRIES, Opening

DEADLINE_SECONDS = 20.0


def configuration(port: int):
    return client_configuration([f"tcp/127.0.0.1:{port}"], timeout=1.0, reconnect=False)


@pytest.fixture
def port():
    return free_port()


@pytest.fixture
def silent():
    """A port where connections are taken and nobody ever says a word."""
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()
        yield listening.getsockname()[1]


def deadline() -> float:
    return time.monotonic() + DEADLINE_SECONDS


def until(condition) -> None:
    end = deadline()
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.001)


def test_one_that_comes_before_the_server_waits_for_it(port):
    opening = Opening(configuration(port))
    found = []
    waiting = threading.Thread(target=lambda: found.append(opening.wait(deadline(), threading.Event())))
    waiting.start()
    until(lambda: opening.failure is not None)
    server = open_session(server_configuration(listen=[f"tcp/127.0.0.1:{port}"], connect=[]))
    waiting.join(DEADLINE_SECONDS)
    (session,) = found
    assert opening.tries >= 2
    assert not session.is_closed()
    close_session(session, [])
    close_session(server, [])


def test_a_deadline_that_is_over_leaves_time_for_one_try(port):
    server = open_session(server_configuration(listen=[f"tcp/127.0.0.1:{port}"], connect=[]))
    session = Opening(configuration(port)).wait(time.monotonic() - 1.0, threading.Event())
    assert not session.is_closed()
    close_session(session, [])
    close_session(server, [])


def test_a_try_that_ends_in_a_way_nobody_thought_of_makes_room_for_the_next(port, monkeypatch):
    def broken(configuration):
        raise RuntimeError("broken")

    monkeypatch.setattr("kuglice_client.link.opening.open_session", broken)
    monkeypatch.setattr(threading, "excepthook", lambda told: None)
    opening, now = Opening(configuration(port)), time.monotonic()
    for turn in range(1, 2 * TRIES):
        until(lambda: not opening.under_way)
        opening.poll(now + turn * STAGGER_SECONDS)
    assert opening.tries == 2 * TRIES
    opening.end()


def test_nobody_at_all_is_told_with_the_endpoint(port):
    with pytest.raises(JoinError, match=f"cannot connect to tcp/127.0.0.1:{port}"):
        Opening(configuration(port)).wait(time.monotonic() + 0.3, threading.Event())


def test_a_try_that_gets_no_answer_is_not_waited_for(silent):
    opening, now = Opening(configuration(silent)), time.monotonic()
    turns = 0
    # On a busy machine the first are over before the last have begun.
    while opening.tries < TRIES or turns < 10 * TRIES:
        turns += 1
        assert opening.poll(now + turns * STAGGER_SECONDS) is None
        assert opening.under_way <= TRIES, "there are not more than so many at a time"
    opening.end()


def test_datagrams_without_their_stream_are_no_session(port):
    server = open_session(server_configuration(listen=[f"udp/127.0.0.1:{port}?rel=0"], connect=[]))
    opening = Opening(client_configuration([f"tcp+udp/127.0.0.1:{port}"], timeout=1.0, reconnect=False))
    until(lambda: opening.failure is not None)
    assert opening.poll(time.monotonic()) is None
    assert "only datagrams came up" in str(opening.failure)
    opening.end()
    close_session(server, [])


def test_what_opens_after_the_end_is_closed(port):
    server = open_session(server_configuration(listen=[f"tcp/127.0.0.1:{port}"], connect=[]))
    opening = Opening(configuration(port))
    opening.end()
    assert opening.poll(time.monotonic() + STAGGER_SECONDS) is None
    until(lambda: not opening.under_way)
    until(lambda: not open_links(server))
    close_session(server, [])


def test_whoever_stops_is_not_kept_waiting(silent):
    stop = threading.Event()
    stop.set()
    with pytest.raises(JoinError, match="stopped while connecting"):
        Opening(configuration(silent)).wait(deadline(), stop)
