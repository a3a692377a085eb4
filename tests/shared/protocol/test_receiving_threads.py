"""Whoever leaves a server does not keep it from hearing the others.

The server of a world reads all datagrams in one place, which waits until each is taken by the thread that receives for
its session. A session that ends over a long way keeps its thread for a round trip, and Zenoh has two of them by
default: when several clients left at once, or closed the tries of theirs that were not needed, the inputs of all others
were read up to 0.6 s later. At 300 ms round trip that made 8 to 90 of 1,000 inputs late, in the first second of
a game above all.
"""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

PROGRAM = """
import os, sys, time
from kuglice.processes import free_port
from kuglice.protocol import client_configuration, close_session, open_session, server_configuration

def receiving():
    names = [open(f"/proc/self/task/{task}/comm").read() for task in os.listdir("/proc/self/task")]
    return sum(name.startswith("rx-") for name in names)

here = [f"tcp+udp/127.0.0.1:{free_port()}"]
server = open_session(server_configuration(listen=here, connect=[]))
# The threads are made for the first link.
client = open_session(client_configuration(here, timeout=10.0))
until = time.monotonic() + 60
while receiving() < int(sys.argv[1]) and time.monotonic() < until:
    time.sleep(0.01)
print(receiving())
close_session(client, [])
close_session(server, [])
"""


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="threads have no names to read here")
@pytest.mark.parametrize(("told", "threads"), [(None, 32), ("(rx: (worker_threads: 5))", 5)])
def test_a_session_receives_with_many_threads_unless_told_otherwise(told, threads):
    environment = {name: value for name, value in os.environ.items() if name != "ZENOH_RUNTIME"}
    if told is not None:
        environment["ZENOH_RUNTIME"] = told
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(threads)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    # Zenoh starts others where some of them wait.
    assert threads <= int(done.stdout)
