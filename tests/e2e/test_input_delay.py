"""Who would rather wait a little than see others jump acts some ticks later."""

from __future__ import annotations

import math
import time

import pytest

from e2e.processes import until
from kuglice.errors import ProtocolError
from kuglice.inputs import Kick
from kuglice.replay import Replay
from kuglice_client import Client, ClientSettings

DELAY = 12


def test_an_input_acts_so_many_ticks_later(server, endpoint, tmp_path):
    with Client(ClientSettings(connect=(endpoint,), name="ana", input_delay=DELAY)) as client:

        def playing(condition) -> None:
            until(lambda: client.turn(time.monotonic()) >= 0 and condition())

        playing(lambda: client.own is not None and client.confirmed.tick > 30)
        reached = client.replica.prediction.world.tick
        client.act(Kick(vx=0.0, vy=3.0))
        due = math.floor(client.replica.clock.target(time.monotonic()))
        # Told that it will act as soon as it has come, she waits until it has.
        playing(
            lambda: client.replica.player.outbox.accepted == 1 and client.confirmed.tick > due + 3 * DELAY
        )
        late = client.replica.player.outbox.late
    server.signal(2)
    server.figures()
    replay = Replay.load(tmp_path / "run.kuglice")
    (acted,) = [tick for tick in range(len(replay)) for one in replay.inputs(tick) if isinstance(one, Kick)]
    assert acted >= reached + DELAY
    assert late or acted <= max(reached, due) + DELAY, "and no later, if it came in time"


@pytest.mark.parametrize("delay", [-1, 31])
def test_a_delay_out_of_bounds_is_an_error(delay):
    with pytest.raises(ProtocolError, match=f"input delay {delay}: must be within 0 and 30 ticks"):
        ClientSettings(input_delay=delay)
