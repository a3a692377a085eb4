"""A stream that stops altogether, and datagrams that never come: the rest goes on, and what is missing is said."""

from __future__ import annotations

import logging
import math
import time

from e2e.processes import until
from e2e.verdict import assert_all_equal
from kuglice.inputs import Thrust
from kuglice_client import Client, ClientSettings


def test_ticks_are_asked_for_where_the_stream_brings_none_any_more(server, endpoint, tmp_path):
    last_heard = math.inf
    settings = ClientSettings(connect=(endpoint,), name="ana", lose=lambda tick: tick > last_heard)
    with Client(settings) as client:
        # From when it is there, which takes its time on a busy machine.
        last_heard = client.confirmed.tick + 60

        def turned(condition) -> bool:
            client.turn(time.monotonic())
            return condition()

        until(lambda: turned(lambda: client.confirmed.tick > last_heard + 30), what="a silence is noticed")
        client.act(Thrust(x=5.0, y=0.0))
        until(
            lambda: turned(lambda: client.replica.player.outbox.accepted == 1), what="what acts is known to"
        )
        until(lambda: turned(lambda: client.confirmed.tick > last_heard + 120), what="it goes on")
        assert not client.moment(1.0).silent, "what is asked for is news as well"
        lead = client.replica.prediction.world.tick - client.confirmed.tick
        summary = client.summary()
    server.signal(2)
    server.figures()
    assert lead > 0, "the prediction goes on too"
    assert summary["ticks_healed_by_history"] >= 100
    assert summary["silences_asked"] > 0
    assert (summary["gaps_skipped"], summary["snapshots_taken"]) == (0, 0)
    assert_all_equal(tmp_path / "run.kuglice", [summary])


def test_datagrams_that_nobody_answers_are_told_of_once(server, endpoint, tmp_path, caplog):
    """The server listens on tcp alone."""
    caplog.set_level(logging.WARNING)
    both = endpoint.replace("tcp/", "tcp+udp/")
    until(lambda: "balls on" in server.err, what="the server is there")
    with Client(ClientSettings(connect=(both,), name="ana", bot="chaser")) as client:
        began = time.monotonic()

        def turned() -> float:
            client.turn(time.monotonic())
            return time.monotonic() - began

        until(lambda: turned() and any("datagram" in text for text in caplog.messages), what="it is told")
        told = time.monotonic() - began
        until(lambda: turned() > told + 2.5, what="some more seconds")
        summary = client.summary()
    server.signal(2)
    server.figures()
    assert [text for text in caplog.messages if "datagram" in text] == [
        "the datagram link (udp) never came up: everything goes over tcp alone"
    ]
    assert summary["links"] == "tcp"
    assert_all_equal(tmp_path / "run.kuglice", [summary])
