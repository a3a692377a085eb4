"""A stranger's broken datagrams can stop Zenoh from reading any: the server says so, and the game goes on without.

Found as the inputs of all clients of a server that came four seconds late and then over tcp alone, without a word.
Should a newer Zenoh go on reading, this test has nothing to warn of any more, and unread.py may go.
"""

from __future__ import annotations

import socket
import time

import pytest

from e2e.processes import until
from kuglice.protocol.unread import TABLES

BROKEN = b"\x55" * 20
SENDERS = 50
"""Between two looks at the server."""


def send_broken(address: tuple[str, int]) -> None:
    """To stop the reading, two more must be on their way just when the link that the first one made ends."""
    for number in range(SENDERS):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
            for _ in range(2 + number % 20):
                stranger.sendto(BROKEN, address)
    time.sleep(0.05)


@pytest.mark.skipif(not TABLES[0].exists(), reason="the system does not tell what waits in a socket")
def test_a_server_whose_datagrams_are_stopped_says_so_and_is_played_over_the_stream(start, endpoint, scene):
    listen = endpoint.replace("tcp/", "tcp+udp/")
    server = start("server", scene, "--listen", listen, "--json")
    until(lambda: "balls on" in server.err, what="the server is there")
    host, port = listen.partition("/")[2].rsplit(":", 1)

    def stopped() -> bool:
        send_broken((host, int(port)))
        return "are not read any more" in server.err

    until(stopped, what="the reading has stopped")
    figures = start(
        *("client", "--connect", listen, "--name", "ana", "--bot", "orbiter", "--seconds", 2, "--json")
    ).figures()
    assert figures["agreed"]
    assert figures["links"] == "tcp"
    assert figures["inputs_accepted"] > 0
    server.end()
