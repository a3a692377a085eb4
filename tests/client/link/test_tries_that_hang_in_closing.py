"""Regression: after a cut on a bad link, no session was opened any more for five seconds at a time.

A try that is not needed is closed: one that came second, or to which only datagrams came up. On a bad link closing
takes Zenoh its five seconds, and a try kept its place until then: five of them closing, and no other was begun, just
when the link was back and the next would have been open at once.

The sessions are real; what they do not do here, unless the test lets them, is to end.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import pytest
import zenoh

from e2e.processes import until
from kuglice.aside import under_way
from kuglice.processes import free_port
from kuglice.protocol import (
    client_configuration,
    close_session,
    open_links,
    open_session,
    server_configuration,
)
from kuglice_client.link import opening as room
from kuglice_client.link.opening import STAGGER_SECONDS, TRIES, Opening

DEADLINE_SECONDS = 30.0
FOR_EVER = 3600.0


class Unclosed:
    """A session that ends when it is let to."""

    def __init__(self, session: zenoh.Session, let: threading.Event) -> None:
        self._session = session
        self._let = let
        self.info = session.info

    def close(self) -> None:
        self._let.wait(FOR_EVER)
        self._session.close()


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def opened(monkeypatch) -> Iterator[list[Unclosed]]:
    """Those that were opened; whoever waits for their ends at all waits for ever."""
    found: list[Unclosed] = []
    let = threading.Event()

    def open_unclosed(configuration):
        found.append(Unclosed(open_session(configuration), let))
        return found[-1]

    def close_in_its_time(session, declared, *, timeout=FOR_EVER):
        return close_session(session, declared, timeout=FOR_EVER if timeout else 0.0)

    monkeypatch.setattr(room, "open_session", open_unclosed)
    monkeypatch.setattr(room, "close_session", close_in_its_time)
    yield found
    let.set()
    until(lambda: "close zenoh session" not in under_way(), what="all sessions end")


def listening(*kinds: str) -> zenoh.Session:
    return open_session(server_configuration(listen=kinds, connect=[]))


def test_another_try_is_begun_however_many_are_closing_and_is_the_session(port, opened):
    datagrams_alone = listening(f"udp/127.0.0.1:{port}?rel=0")
    both = client_configuration([f"tcp+udp/127.0.0.1:{port}"], timeout=1.0, reconnect=False)
    opening, now, turns = Opening(both), time.monotonic(), 0

    def all_hang() -> bool:
        nonlocal turns
        turns += 1
        assert opening.poll(now + turns * STAGGER_SECONDS) is None, "datagrams alone are no session"
        return len(opened) > TRIES

    until(all_hang, seconds=DEADLINE_SECONDS, what=f"more than {TRIES} tries that are closing")
    until(lambda: not opening.under_way, what="none is in the midst of opening")
    close_session(datagrams_alone, [])
    server = listening(f"tcp/127.0.0.1:{port}", f"udp/127.0.0.1:{port}?rel=0")
    session = opening.wait(time.monotonic() + DEADLINE_SECONDS, threading.Event())
    assert session in opened
    until(lambda: "tcp" in open_links(session), what="it has the stream")
    opening.end()
    close_session(server, [])
