"""A contact at rest is infinitely many collisions in no time; `event` bears it, at any restitution."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from stability.worlds import make

GRAVITY = kg.Gravity(0.0, -10.0)
TICKS = 600
RESTITUTIONS = [0.0, 0.3, 0.8, 0.99, 1.0]
BESIDES = {
    "gravity alone": [],
    "a pull from below": [kg.Attractor(0.0, -3.0, 10.0, 1.0)],
    "a weak spring from above": [kg.Spring(0.0, 9.0, 0.1)],
    "drag": [kg.Drag(0.3)],
}
"""Forces next to gravity; all but the first vary. In none of them does a ball at rest rise."""


def assert_at_rest(world: kg.World, ticks: int = TICKS) -> None:
    """Not a bit of the balls changes: neither place nor velocity."""
    position = world.position
    world.run(ticks)
    assert (world.velocity == 0).all()
    assert (world.position == position).all()


@given(
    restitution=st.floats(0, 1),
    radius=st.floats(0.01, 10),
    gravity=st.floats(0.01, 1e4),
    tick_rate=st.floats(1, 1000),
)
def test_a_ball_on_a_floor_stays_whatever_the_numbers(restitution, radius, gravity, tick_rate):
    # The floor is at 0 and the centre at one radius: the gap is exactly 0.
    world = make(
        [[0.0, radius]],
        radius=radius,
        box=(-20, 0, 20, 40),
        forces=[kg.Gravity(0.0, -gravity)],
        restitution=restitution,
        tick_rate=tick_rate,
    )
    assert_at_rest(world, 50)
    assert world.wall_hits == 0


@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("besides", BESIDES)
def test_a_ball_on_a_floor(restitution, besides):
    forces = [GRAVITY, *BESIDES[besides]]
    assert_at_rest(make([[0.0, 0.5]], box=(-5, 0, 5, 10), forces=forces, restitution=restitution))


@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("besides", BESIDES)
def test_a_ball_on_a_peg_exactly_below_it(restitution, besides):
    forces = [GRAVITY, *BESIDES[besides]]
    world = make([[0.0, 0.0], [0.0, 1.0]], mass=[math.inf, 1.0], forces=forces, restitution=restitution)
    assert_at_rest(world)


@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_a_column_of_balls(restitution):
    world = make(
        [[0.0, 0.5], [0.0, 1.5], [0.0, 2.5]], box=(-5, 0, 5, 10), forces=[GRAVITY], restitution=restitution
    )
    assert_at_rest(world)


@given(restitution=st.floats(0, 1), floor=st.floats(-1, 1), radius=st.floats(0.1, 1))
def test_a_gap_of_rounding_is_rest_too(restitution, floor, radius):
    # The sum is rounded: the ball hovers up to some ulps above the floor, as far as a scene lets it.
    height = floor + radius
    while height - radius < floor:
        height = math.nextafter(height, math.inf)
    world = make(
        [[0.0, height]],
        radius=radius,
        box=(-5, floor, 5, 10),
        forces=[GRAVITY],
        restitution=restitution,
    )
    world.run(60)
    # A fall of 1e-12 radii is documented as rounding (contacts/event/contact.rs).
    assert abs(world.position[0, 1] - height) < 2e-12 * radius
    assert world.velocity[0, 1] == 0


@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_a_ball_that_leans_on_another_and_a_wall(restitution):
    # Centres 1 apart: 0.3^2 + 0.9539...^2 = 1; the slot is 1.3 wide, so both touch a wall and one the floor.
    world = make(
        [[0.5, 0.5], [0.8, 0.5 + math.sqrt(1 - 0.09)]],
        box=(0, 0, 1.3, 10),
        forces=[GRAVITY],
        restitution=restitution,
        allow_overlap=True,
    )
    position, energy = world.position, world.energy
    world.run(TICKS)
    assert np.abs(world.position - position).max() < 1e-9
    assert world.energy <= energy + 1e-9


@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_a_ball_in_the_valley_of_two_pegs(restitution):
    # A 3-4-5 triangle: both distances are exactly 1.
    world = make(
        [[-0.6, 0.0], [0.6, 0.0], [0.0, 0.8]],
        mass=[math.inf, math.inf, 1.0],
        forces=[GRAVITY],
        restitution=restitution,
    )
    energy = world.energy
    world.run(TICKS)
    assert np.abs(world.position[2] - [0.0, 0.8]).max() < 1e-9
    assert abs(world.energy - energy) < 1e-9


@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_a_ball_slides_along_a_floor_as_if_it_were_not_there(restitution):
    # Velocity Verlet keeps v^2 + omega^2 (1 - (omega h)^2 / 4) x^2 (see test_oscillator), omega^2 = k / m.
    omega, h, amplitude = 2.0, 1 / 60, 3.0
    world = make(
        [[amplitude, 0.5]],
        box=(-5, 0, 5, 10),
        forces=[GRAVITY, kg.Spring(0.0, 0.5, omega**2)],
        restitution=restitution,
    )
    for _ in range(100):
        world.run(3)
        (x, y), (u, v) = world.position[0], world.velocity[0]
        assert (y, v) == (0.5, 0.0)
        stiffness = omega**2 * (1 - (omega * h) ** 2 / 4)
        assert u**2 + stiffness * x**2 == pytest.approx(stiffness * amplitude**2, rel=1e-12)
