"""Regression: an own input with which a tick cannot be made ended the client that predicted it.

Kick by kick it is allowed, but the step refuses the tick: the server goes on without the input, and so must we.
"""

from __future__ import annotations

import pytest

from kuglice import Model, World
from kuglice.errors import StepError
from kuglice.inputs import Join, Kick, pack
from kuglice.protocol import StretchedTick, Tick
from kuglice_client.follow import Follower
from kuglice_client.prediction import Prediction
from server.small_arena import small_arena

IMPOSSIBLE = Kick(client=1, sequence=7, vx=1e150, vy=0.0)


@pytest.fixture
def confirmed() -> World:
    world = World(small_arena(), Model(contacts="event"))
    world.step([Join(client=1, x=1.0, y=1.0, radius=0.4, mass=2.0)])
    return world


def confirm(prediction: Prediction, confirmed: World, inputs: bytes = b"") -> None:
    tick = confirmed.tick
    confirmed.step(inputs)
    prediction.confirm(StretchedTick(tick, inputs, confirmed.state_hash))
    prediction.reconcile(confirmed)


def test_the_kick_is_impossible(confirmed: World) -> None:
    with pytest.raises(StepError):
        confirmed.step([IMPOSSIBLE])


def test_prediction_waits_before_such_a_tick_and_goes_on_when_the_server_has(confirmed: World) -> None:
    prediction = Prediction(confirmed, limit=10)
    prediction.step()
    impossible = prediction.world.tick
    prediction.act(IMPOSSIBLE, impossible)
    prediction.step()
    assert prediction.world.tick == impossible
    assert not prediction.may_step(confirmed)

    prediction.settle(IMPOSSIBLE, impossible, impossible)
    confirm(prediction, confirmed)
    assert not prediction.may_step(confirmed)
    confirm(prediction, confirmed)
    assert confirmed.tick == impossible + 1
    for _ in range(3):
        assert prediction.may_step(confirmed)
        prediction.step()
    for _ in range(3):
        confirm(prediction, confirmed)
    assert prediction.world.snapshot() == confirmed.snapshot()
    assert prediction.rollbacks == 0


def test_a_tick_of_the_stream_that_cannot_be_stepped_is_a_gap_and_not_the_end(confirmed: World) -> None:
    follower = Follower(confirmed)
    follower.take(Tick.of(1, [StretchedTick(confirmed.tick, pack([IMPOSSIBLE]), 0)]))
    assert list(follower.advance()) == []
    assert follower.unusable == 1
