"""Regression: whoever said hello and vanished kept everybody else from joining, for ten seconds each.

A server that has been greeted answers, waits ten seconds for what follows, and closes the socket. Zenoh has close(2)
wait another ten for the answer to be acknowledged, in the thread that accepts, of which there was one. Three packets of
98 bytes kept a server shut for half a minute; and so did the tries of clients whose link was cut while they connected,
which made some of them come back seconds after the others. Now many threads accept.
"""

from __future__ import annotations

import socket
import subprocess
import sys
import threading
from collections import Counter

import pytest

from e2e.bad_network import Play
from e2e.processes import until
from kuglice.errors import ProtocolError
from kuglice.lab.network import Conditions, open_link
from kuglice.lab.network.tun_device import why_impossible
from kuglice.protocol import client_configuration, open_session

STRANGERS = 12
"""More than can be waited for below, if one is closed after the other."""
LONG_WAY = Conditions(round_trip=1.0)
GREET = """
import socket, sys, time
host, port = sys.argv[1].rsplit(":", 1)
strangers = [socket.socket() for _ in range(int(sys.argv[3]))]
for one in strangers:
    # All at once: on a long way, one after the other would be given up one after the other.
    one.setblocking(False)
    one.connect_ex((host, int(port)))
for one in strangers:
    one.setblocking(True)
    one.sendall(bytes.fromhex(sys.argv[2]))
time.sleep(600)
"""
CLOSED_UNDELIVERED = "04"
"""FIN_WAIT1, in /proc/net/tcp."""


def greeting() -> bytes:
    """What a client says first."""
    heard = []

    def listen() -> None:
        with listening.accept()[0] as connection:
            heard.append(connection.recv(4096))

    with socket.create_server(("127.0.0.1", 0)) as listening:
        listener = threading.Thread(target=listen)
        listener.start()
        with pytest.raises(ProtocolError):
            open_session(
                client_configuration(
                    [f"tcp/127.0.0.1:{listening.getsockname()[1]}"], timeout=1.0, reconnect=False
                )
            )
        listener.join()
    return heard[0]


@pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")
def test_strangers_who_greet_and_vanish_keep_nobody_from_joining(start, scene, tmp_path):
    with open_link(LONG_WAY, "tunnel") as link:
        play = Play(start, scene, tmp_path, link)
        until(lambda: "balls on" in play.server.err, what="the server is there")

        def sockets() -> list[list[str]]:
            table = subprocess.run(
                [*link.server_prefix, "cat", "/proc/net/tcp"], capture_output=True, text=True, check=True
            )
            return [line.split() for line in table.stdout.splitlines()[1:]]

        def unacknowledged() -> int:
            return sum(not one[4].startswith("00000000:") for one in sockets())

        strangers = subprocess.Popen(
            [
                *link.client_prefix,
                sys.executable,
                "-c",
                GREET,
                link.client_address,
                greeting().hex(),
                str(STRANGERS),
            ]
        )
        try:
            until(lambda: unacknowledged() == STRANGERS, what="all strangers are answered")
            link.cut(600.0)
            until(
                lambda: Counter(one[3] for one in sockets())[CLOSED_UNDELIVERED] > 0,
                what="the server has given a stranger up",
            )
            # Beside the server, where no link is cut.
            client = start(
                *(
                    "client",
                    "--connect",
                    f"tcp/{link.server_address}",
                    "--name",
                    "ana",
                    "--wait",
                    30,
                    "--json",
                ),
                *("--seconds", 1),
                prefix=link.server_prefix,
            )
            assert client.figures()["agreed"]
        finally:
            strangers.kill()
            strangers.wait()
        play.server.end()
