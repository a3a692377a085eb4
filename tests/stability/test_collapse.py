"""Below restitution 1 infinitely many collisions fit in finite time; `event` ends them and gains no energy."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from kuglice import _core
from stability.worlds import make

GRAVITY = kg.Gravity(0.0, -10.0)
TICK_RATE = 60.0
JITTER = 10.0 / TICK_RATE**2
"""A fall of one tick is g h^2 / 2: less than this counts as lying still."""


def run_without_gain(world: kg.World, ticks: int, limit: float = 1e-12) -> None:
    """No tick ends with more energy than it began with, but for rounding."""
    energy = world.energy
    allowed = limit * max(abs(energy), world.kinetic_energy, 1.0)
    for _ in range(ticks):
        world.step()
        assert world.energy <= energy + allowed
        energy = world.energy


def collapse_time(drop: float, restitution: float) -> float:
    """t1 (1 + 2 e + 2 e^2 + ...) = t1 (1 + e) / (1 - e), with t1 = sqrt(2 d / g): the end of all flights."""
    return math.sqrt(2 * drop / 10.0) * (1 + restitution) / (1 - restitution)


@pytest.mark.parametrize("restitution", [0.0, 0.1, 0.5, 0.8, 0.9])
@pytest.mark.parametrize("under", ["floor", "peg"])
def test_a_bouncing_ball_lies_still_after_the_sum_of_its_flights(restitution, under):
    if under == "floor":
        world = make([[0.0, 5.5]], box=(-5, 0, 5, 20), forces=[GRAVITY], restitution=restitution)
    else:
        world = make(
            [[0.0, -0.5], [0.0, 5.5]], mass=[math.inf, 1.0], forces=[GRAVITY], restitution=restitution
        )
    end = collapse_time(5.0, restitution)
    run_without_gain(world, math.floor(0.9 * end * TICK_RATE))
    assert world.position[-1, 1] > 0.5 or restitution == 0.0
    run_without_gain(world, math.ceil(0.1 * end * TICK_RATE) + 60)
    for _ in range(60):
        world.step()
        assert world.position[-1, 1] - 0.5 < JITTER
        assert abs(world.velocity[-1, 1]) <= 10.0 / TICK_RATE
        assert world.position[-1, 1] > 0.5 - 1e-12
    # Hits until a hop is shorter than a tick: log(v1 / (g h)) / log(1 / e); then some per tick at most.
    assert world.collisions + world.wall_hits < 1000


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9])
def test_collapse_in_one_long_tick(restitution):
    world = make([[0.0, 5.5]], box=(-5, 0, 5, 20), forces=[GRAVITY], restitution=restitution)
    energy = world.energy
    world.step(dt=2 * collapse_time(5.0, restitution))
    assert 0 < world.wall_hits < 10_000
    assert world.energy < energy
    assert world.position[0, 1] >= 0.5 - 1e-12


@given(
    restitution=st.floats(0, 0.99),
    power=st.floats(0, 8),
    gaps=st.tuples(st.floats(0.1, 3), st.floats(0.1, 3)),
    speed=st.floats(0.5, 10),
)
def test_a_ball_squeezed_between_two_closing_heavy_ones(restitution, power, gaps, speed):
    # Three in line below e = 7 - 4 sqrt(3) collapse at equal masses; heavy outer ones at any e (McNamara and
    # Young 1992, doi 10.1063/1.858323).
    heavy = 10.0**power
    world = make(
        [[-1 - gaps[0], 0.0], [0.0, 0.0], [1 + gaps[1], 0.0]],
        [[speed, 0.0], [0.0, 0.0], [-speed, 0.0]],
        mass=[heavy, 1.0, heavy],
        restitution=restitution,
    )
    momentum = world.momentum[0]
    run_without_gain(world, 100 + math.ceil(TICK_RATE * 2 * max(gaps) / speed))
    assert 2 <= world.collisions < 100 * (1 + math.sqrt(heavy))
    assert world.momentum[0] == pytest.approx(momentum, abs=1e-9 * heavy * speed)
    x = world.position[:, 0]
    assert (x[1:] - x[:-1] > 1 - 1e-9).all()


@pytest.mark.parametrize("restitution", [0.0, 0.2, 0.5, 0.8, 0.95])
@pytest.mark.parametrize(("count", "width"), [(2, 1.3), (3, 1.9), (8, 3.3), (20, 4.5)])
@pytest.mark.parametrize("seed", range(4))
def test_balls_that_fall_on_a_heap_in_a_narrow_box(count, width, restitution, seed):
    world = heap(count, width, restitution, seed)
    run_without_gain(world, 360, 1e-10)
    assert world.position[:, 1].min() > 0.5 - 1e-9


def heap(count: int, width: float, restitution: float, seed: int) -> kg.World:
    """Balls of diameter 1 that fall into a slot, where they lean on each other and on both walls."""
    random = _core.random_uniform(seed, 0, 0, 3 * count).reshape(count, 3)
    position = [[0.5 + u[0] * (width - 1), 0.5 + 1.05 * index] for index, u in enumerate(random)]
    velocity = 4.0 * (random[:, 1:] - 0.5)
    box = (0, 0, width, 1.1 * count + 1)
    return make(position, velocity, box=box, forces=[GRAVITY], restitution=restitution, tick_rate=120.0)
