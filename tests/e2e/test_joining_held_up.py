"""The answers of a join were held up by two seconds, as lost segments do, and taken for how long the way is.

The clock wanted to be three seconds ahead: that is more than is ever predicted, so that entering waited for its own
limit of five seconds, and then half a minute went by with seconds of lead.

And where the answer that says which tick it is came behind the state, a second old, the tick of then was taken for that
of now: the second that had gone by was shown, played too fast.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from dataclasses import replace

import pytest

from e2e.serving import serving
from kuglice import scenes
from kuglice.processes import free_port
from kuglice.protocol import Keys, Message
from kuglice_client import Client
from kuglice_client.replica import Replica
from kuglice_client.screen import Screen
from kuglice_client.settings import ClientSettings
from kuglice_client.totals import Totals
from kuglice_server.answer import Answers

HELD_UP_SECONDS = 2.0
RATE = 60.0
WORLD = "small"


@pytest.mark.timeout(120)
def test_a_join_whose_answers_were_held_up_asks_once_more_before_it_runs_ahead(start, tmp_path):
    scenes.arena(players=4).save(tmp_path / "arena.toml")
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    server = start("server", tmp_path / "arena.toml", "--listen", endpoint, "--json")
    settings = ClientSettings(connect=(endpoint,), name="ana", wait=30.0)
    with Client(settings) as client:
        joined = replace(client.replica.joined, round_trip=HELD_UP_SECONDS)
        again = Replica(
            joined,
            client.link,
            Keys(joined.about.world),
            settings,
            who=None,
            screen=Screen(),
            study=None,
            totals=Totals(),
            now=time.monotonic(),
        )
        again.enter(deadline=time.monotonic() + 30.0, stop=threading.Event())
        assert again.clock.round_trip < HELD_UP_SECONDS
        assert again.clock.wanted_lead < HELD_UP_SECONDS * RATE
        assert again.prediction.world.tick <= again.follower.world.tick + again.clock.wanted_lead + RATE
    server.signal(2)
    server.figures()


def test_which_tick_it_is_is_asked_again_once_the_state_is_here(monkeypatch):
    told = Answers._tell_about

    def tell_late(answers: Answers) -> Iterator[Message]:
        parts = list(told(answers))
        time.sleep(HELD_UP_SECONDS)
        yield from parts

    monkeypatch.setattr(Answers, "_tell_about", tell_late)
    with (
        serving(WORLD) as (endpoint, server),
        Client(ClientSettings(connect=(endpoint,), world=WORLD, wait=60.0)) as client,
    ):
        joined = client.replica.joined
        assert joined.about.tick + HELD_UP_SECONDS * RATE / 2 < joined.told_tick <= server.world.tick
