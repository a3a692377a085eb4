"""Who writes a game sees what became of each input, plays with a bot of her own, and says how corrections glide."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from e2e.processes import until
from kuglice.errors import LimitError
from kuglice.inputs import Input, Kick, Thrust
from kuglice_client import Client, ClientSettings, Outcome, Sight


def play(client: Client, done: Callable[[], object]) -> None:
    until(lambda: client.turn(time.monotonic()) >= 0 and done())


def test_each_input_has_an_outcome_that_is_told_once(server, endpoint):
    with Client(ClientSettings(connect=(endpoint,), name="ana", exact_inputs=True, wait=60.0)) as client:
        play(client, lambda: client.own is not None and client.confirmed.tick > 10)
        taken = client.act(Kick(vx=1.0, vy=0.0))
        refused = client.act(Kick(vx=99.0, vy=0.0))
        assert [one.sequence for one in (taken, refused)] == [1, 2]
        told: dict[int, Outcome] = {}

        def both() -> bool:
            told.update({one.given.sequence: one for one in client.outcomes()})
            return len(told) == 2

        play(client, both)
        assert told[1].given == taken
        assert told[1].tick is not None
        assert told[1].refused is None
        assert told[2].tick is None
        assert "change of speed 99, at most 5" in (told[2].refused or "")
        assert client.outcomes() == []


def test_any_function_is_a_bot(server, endpoint):
    asked = []

    def climber(sight: Sight) -> Input | None:
        asked.append(sight.own)
        return Thrust(x=0.0, y=5.0) if sight.own is not None else None

    with Client(ClientSettings(connect=(endpoint,), name="ana", bot=climber, wait=60.0)) as client:
        play(client, lambda: client.summary()["inputs_accepted"] >= 1)
        assert client.own in asked


def test_a_spectator_has_no_outcomes(server, endpoint):
    with Client(ClientSettings(connect=(endpoint,), wait=60.0)) as client:
        assert client.outcomes() == []


@pytest.mark.parametrize("name", ["correction_seconds", "correction_limit"])
def test_corrections_that_could_not_glide_are_an_error(name):
    with pytest.raises(LimitError, match="must be greater than 0"):
        Client(ClientSettings(**{name: 0.0}))
