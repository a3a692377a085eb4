"""Regression: sessions that ended over a bad link kept everybody else from joining, and stopped all datagrams.

Zenoh ends a session in the thread that lets new links in, of which there was one, and close(2) waits there for up to
ten seconds until what was said is acknowledged. Meanwhile nobody joined; and where a link of datagrams was not let in
when the second of them came, no datagram of any client was read, for seconds or for good: it showed in one of twenty
games at 300 ms round trip, whose players had closed the tries of joining that were not needed. Now many threads do it.
"""

from __future__ import annotations

import subprocess
import sys
from collections import Counter

import pytest

from e2e.bad_network import Play
from e2e.processes import until
from kuglice.lab.network import Conditions, open_link
from kuglice.lab.network.tun_device import why_impossible

LEAVING = 12
"""Enough that some of them are ended by the thread that is meant, whichever Zenoh takes."""
LONG_WAY = Conditions(round_trip=0.4)
PATIENT_SECONDS = 8
"""Less than close(2) waits for one of them."""
LEAVE = """
import sys, threading, zenoh
from kuglice.protocol import Keys, client_configuration, open_session
configuration = client_configuration([sys.argv[1]], timeout=30.0, reconnect=False)
configuration["transport"]["unicast"]["open_timeout"] = 10_000
sessions = [open_session(configuration) for _ in range(int(sys.argv[2]))]
# Ticks are on their way to them at any time.
heard = [one.declare_subscriber(Keys("small").tick, zenoh.handlers.RingChannel(9)) for one in sessions]
for one in heard:
    one.recv()
print("hear", flush=True)
sys.stdin.read(1)
for one in sessions:
    threading.Thread(target=one.close, daemon=True).start()
sys.stdin.read()
"""
CLOSED_UNDELIVERED = {"04", "09", "0B"}
"""FIN_WAIT1, LAST_ACK and CLOSING, in /proc/net/tcp."""


@pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")
def test_those_who_leave_over_a_link_that_is_cut_keep_nobody_from_joining(start, scene, tmp_path):
    with open_link(LONG_WAY, "tunnel") as link:
        play = Play(start, scene, tmp_path, link)
        until(lambda: "balls on" in play.server.err, what="the server is there")

        def closed_undelivered() -> int:
            table = subprocess.run(
                [*link.server_prefix, "cat", "/proc/net/tcp"], capture_output=True, text=True, check=True
            )
            states = Counter(line.split()[3] for line in table.stdout.splitlines()[1:])
            return sum(states[one] for one in CLOSED_UNDELIVERED)

        with subprocess.Popen(
            [*link.client_prefix, sys.executable, "-c", LEAVE, f"tcp/{link.client_address}", str(LEAVING)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as leaving:
            try:
                assert leaving.stdout is not None
                assert leaving.stdin is not None
                assert leaving.stdout.readline() == "hear\n"
                leaving.stdin.write("\n")
                leaving.stdin.flush()
                until(closed_undelivered, what="the server has closed one of them")
                link.cut(600.0)
                # Beside the server, where no link is cut.
                client = start(
                    *("client", "--connect", f"tcp/{link.server_address}", "--name", "ana"),
                    *("--wait", PATIENT_SECONDS, "--seconds", 1, "--json"),
                    prefix=link.server_prefix,
                )
                assert client.figures()["agreed"]
            finally:
                leaving.kill()
        play.server.end()
