"""Regression: a client that had been stopped for seconds blamed its machine.

"301 ticks behind the stream: this machine steps slower than the server", it said, and caught up 5 ms later.
"""

from __future__ import annotations

import logging

from e2e.processes import until
from e2e.serving import serving
from kuglice_client import Client, ClientSettings


def test_one_that_was_stopped_catches_up_without_a_word_about_its_machine(caplog):
    caplog.set_level(logging.WARNING)
    with (
        serving("small") as (endpoint, server),
        Client(ClientSettings(connect=(endpoint,), world="small", name="ana", wait=60)) as client,
    ):
        client.run(seconds=0.1)
        stopped = server.status().tick
        until(lambda: server.status().tick > stopped + 300, what="the server goes on", seconds=60)
        client.run(seconds=0.5)
        until(lambda: client.run(seconds=0.1) or client.confirmed.tick > stopped + 300, what="ticks")
        assert client.summary()["agreed"]
    assert not [text for text in caplog.messages if "slower than the server" in text]
