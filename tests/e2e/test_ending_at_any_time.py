"""Whoever is told to stop ends soon and in order, whatever it does: connecting, joining, playing, cut off, renewing.

Regression: a client that was stopped while it connected, or while its link was opened anew, ended with "FATAL:
exception not rethrown" and status 134: tries to open a session came back while Python was being taken down
(kuglice/aside.py).
"""

from __future__ import annotations

import signal
import socket
import time

import pytest

from e2e.processes import until
from kuglice.lab.network import Conditions, ProxyLink
from kuglice.protocol import close_session, open_session, server_configuration
from kuglice_client.link.opening import TRIES

TELLING_SECONDS = 0.22
"""After this the signal used to make the process end just when a try was over. Any other time is right too."""
WAIT = ("--wait", 600)
LOOKERS = {
    "client": ("client", "--name", "ana", "--bot", "chaser", "--json", *WAIT),
    "view": ("view", "2,2,10,8", "--json", *WAIT),
}
THERE = {"client": "joined world", "view": "looking at world"}


@pytest.fixture(params=LOOKERS)
def kind(request):
    return request.param


@pytest.fixture(params=[signal.SIGINT, signal.SIGTERM])
def number(request):
    return request.param


def port_of(endpoint: str) -> int:
    return int(endpoint.rpartition(":")[2])


def silent_at(port: int) -> socket.socket:
    """Takes connections, and never says a word."""
    listening = socket.create_server(("127.0.0.1", port))
    listening.settimeout(60.0)
    return listening


def refused(process) -> str:
    assert process.wait() == 2, process.err
    return process.err


def test_while_connecting(start, kind, number, endpoint):
    with silent_at(port_of(endpoint)) as listening:
        connecting = start(*LOOKERS[kind], "--connect", endpoint)
        # One more than there are at a time: from now on one of them is over every 0.3 s.
        tries = [listening.accept()[0] for _ in range(TRIES + 1)]
        time.sleep(TELLING_SECONDS)
        connecting.signal(number)
        assert refused(connecting) == "kuglice: stopped while connecting\n"
        for connection in tries:
            connection.close()


def test_while_joining(start, kind, number, endpoint):
    router = open_session(server_configuration(listen=[endpoint], connect=[]))
    joining = start(*LOOKERS[kind], "--connect", endpoint)
    until(lambda: list(router.info.links()), what="it is connected")
    joining.signal(number)
    assert "stopped while" in refused(joining)
    close_session(router, [])


def test_while_playing(start, kind, number, server, endpoint):
    playing = start(*LOOKERS[kind], "--connect", endpoint)
    until(lambda: THERE[kind] in playing.err, what="it is there")
    playing.signal(number)
    assert playing.wait() in (0, 1), playing.err


def test_while_cut_off(start, kind, number, scene):
    with ProxyLink(Conditions()) as link:
        start("server", scene, "--listen", f"tcp/{link.server_address}")
        cut = start(*LOOKERS[kind], "--connect", f"tcp/{link.client_address}")
        until(lambda: THERE[kind] in cut.err, what="it is there")
        link.cut(600.0)
        cut.signal(number)
        assert cut.wait() in (0, 1), cut.err


def test_while_the_link_is_opened_anew(start, kind, number, server, endpoint):
    renewing = start(*LOOKERS[kind], "--connect", endpoint)
    until(lambda: THERE[kind] in renewing.err, what="it is there")
    server.kill()
    with silent_at(port_of(endpoint)) as listening:
        tries = [listening.accept()[0] for _ in range(3)]
        renewing.signal(number)
        assert renewing.wait() in (0, 1), renewing.err
        for connection in tries:
            connection.close()


def test_a_server_beside_a_client_that_has_frozen(start, number, server, endpoint):
    frozen = start(*LOOKERS["client"], "--connect", endpoint)
    until(lambda: "joined world" in frozen.err, what="it is there")
    frozen.signal(signal.SIGSTOP)
    server.signal(number)
    assert server.figures()["ticks"] > 0
