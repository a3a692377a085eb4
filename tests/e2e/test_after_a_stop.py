"""Regression: a client that had been stopped for seconds blamed its machine.

"301 ticks behind the stream: this machine steps slower than the server", it said, and caught up 5 ms later.
"""

from __future__ import annotations

import logging
import threading

from e2e.processes import free_endpoint, until
from kuglice_client import Client, ClientSettings
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena


def test_one_that_was_stopped_catches_up_without_a_word_about_its_machine(caplog):
    caplog.set_level(logging.WARNING)
    settings = ServerSettings(world="small", listen=(free_endpoint(),))
    stop = threading.Event()
    with Server(small_arena(), settings) as server:
        thread = threading.Thread(target=server.run, args=(stop,))
        thread.start()
        try:
            with Client(
                ClientSettings(connect=settings.listen, world="small", name="ana", wait=60)
            ) as client:
                client.run(seconds=0.1)
                stopped = server.status().tick
                until(lambda: server.status().tick > stopped + 300, what="the server goes on", seconds=60)
                client.run(seconds=0.5)
                until(lambda: client.run(seconds=0.1) or client.confirmed.tick > stopped + 300, what="ticks")
                assert client.summary()["agreed"]
        finally:
            stop.set()
            thread.join()
    assert not [text for text in caplog.messages if "slower than the server" in text]
