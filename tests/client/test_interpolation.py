"""What is drawn lies between two states, and a ball that was not there before is where it is."""

from __future__ import annotations

import numpy as np
import pytest

from kuglice.inputs import Remove, Spawn
from kuglice_client.interpolation import interpolate
from kuglice_client.render.moment import HashState

STATE = HashState(1, 2, "equal")


@pytest.mark.parametrize("alpha", [0.0, 0.25, 1.0])
def test_alpha_of_the_current_state_and_the_rest_of_the_previous_one(authority, alpha):
    previous = authority.world.clone()
    authority.step()
    moment = interpolate(previous, authority.world, alpha, STATE, nodes=False)
    expected = alpha * authority.world.position + (1 - alpha) * previous.position
    np.testing.assert_array_equal(moment.position, expected)
    assert moment.hash_state == STATE


def test_balls_that_come_and_go(authority):
    previous = authority.world.clone()
    authority.step([Spawn(x=10.0, y=3.5, radius=0.3, mass=1.0), Remove(ball=0)])
    current = authority.world
    moment = interpolate(previous, current, 0.5, STATE, nodes=True)
    np.testing.assert_array_equal(moment.id, current.id)
    newest = int(current.id.argmax())
    np.testing.assert_array_equal(moment.position[newest], current.position[newest])
    assert moment.nodes is not None


def test_a_moment_is_a_copy(authority):
    before = authority.world.clone()
    moment = interpolate(before, authority.world, 1.0, STATE, nodes=False)
    seen = moment.position.copy()
    authority.step()
    np.testing.assert_array_equal(moment.position, seen)
