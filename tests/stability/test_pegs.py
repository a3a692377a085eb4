"""Parabola against a fixed ball: roots of a quartic, and the energy kept to rounding."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from stability.overlaps import beyond_walls, deepest
from stability.worlds import make

GRAVITY = 10.0


@given(
    x=st.floats(-0.95, 0.95),
    drop=st.floats(0.01, 20),
    push=st.floats(-2, 2),
    tick_rate=st.sampled_from([0.1, 1.0, 60.0, 1000.0]),
)
def test_a_hit_on_a_peg_is_on_its_circle_and_elastic(x, drop, push, tick_rate):
    """Against the path: p + v t + g t^2 / 2, cut with the circle of radius r1 + r2 by halving."""
    start = np.array([x, math.sqrt(1 - x * x) + drop])
    velocity = np.array([push, 0.0])
    pull = np.array([0.0, -GRAVITY])

    def path(t):
        return start + velocity * t + pull * (t * t / 2)

    # Far enough to fall past the peg; fine enough not to jump over a graze that counts.
    times = np.linspace(0, 2 * math.sqrt(2 * (drop + 2) / GRAVITY), 4001)
    places = start + velocity * times[:, None] + pull * (times[:, None] ** 2 / 2)
    gaps = np.hypot(*places.T) - 1
    inside = np.flatnonzero(gaps < -1e-3)
    if len(inside) == 0:
        return
    low, high = times[np.flatnonzero(gaps[: inside[0]] > 0)[-1]], times[inside[0]]
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if np.hypot(*path(middle)) > 1 else (low, middle)
    normal = path(low)
    incoming = velocity + pull * low
    after = incoming - 2 * (incoming @ normal) * normal
    world = make(
        [[0.0, 0.0], start],
        [[0.0, 0.0], velocity],
        mass=[math.inf, 1.0],
        forces=[kg.Gravity(*pull)],
        tick_rate=tick_rate,
    )
    # A moment after the hit, before any other.
    moment = 1e-3
    whole = int((low + moment) * tick_rate)
    world.run(whole)
    rest = low + moment - whole / tick_rate
    if rest > 0:
        world.step(dt=rest)
    assert world.collisions == 1
    assert world.position[1] == pytest.approx(normal + after * moment + pull * (moment**2 / 2), abs=1e-9)
    assert world.velocity[1] == pytest.approx(after + pull * moment, abs=1e-9)


def board(seed: int, contacts: str = "event", broadphase: str = "loose_quadtree") -> kg.World:
    """An elastic Galton board: 60 balls that fall through five rows of pegs, again and again."""
    random = np.random.default_rng(seed)
    row, column = np.divmod(np.arange(40), 8)
    pegs = np.stack([1.5 + 1.8 * column + 0.9 * (row % 2), 2.0 + 1.6 * row], axis=1)
    high, wide = np.divmod(np.arange(60), 15)
    balls = np.stack([0.7 + wide, 10.0 + high], axis=1) + random.uniform(-0.2, 0.2, size=(60, 2))
    return make(
        np.concatenate([pegs, balls]),
        np.concatenate([np.zeros((40, 2)), random.normal(size=(60, 2))]),
        radius=[0.3] * 40 + [0.25] * 60,
        mass=[math.inf] * 40 + [1.0] * 60,
        box=(0, 0, 16, 20),
        forces=[kg.Gravity(0.0, -GRAVITY)],
        contacts=contacts,
        broadphase=broadphase,
    )


@pytest.mark.parametrize("seed", [1, 2])
def test_an_elastic_board_keeps_its_energy(seed):
    world = board(seed)
    energy, worst = world.energy, 0.0
    for _ in range(600):
        world.step()
        worst = max(worst, abs(world.energy / energy - 1))
        assert deepest(world) < 1e-12
        assert beyond_walls(world) < 1e-12
    assert world.collisions > 1000
    assert worst < 1e-12
    # Pegs have not moved.
    assert (world.position[:40] == world.scene.balls.position[:40]).all()


def test_overlap_keeps_the_energy_of_the_board_too_but_not_its_balls_apart():
    world = board(1, "overlap")
    energy, worst = world.energy, 0.0
    for _ in range(600):
        world.step()
        worst = max(worst, deepest(world))
    assert world.energy == pytest.approx(energy, rel=1e-12)
    assert worst > 0.3


@pytest.mark.parametrize("arc", [0.02, 0.3, 1.0])
def test_a_ball_slides_off_a_peg_where_the_formula_says(arc):
    # Released at angle a from the top it leaves a fixed circle at cos b = 2/3 cos a: m v^2 / R = m g cos b,
    # v^2 = 2 g R (cos a - cos b). A chain of parabolas that touch the circle comes to it with the tick.
    reach, tick_rate = 1.0, 4000.0
    world = make(
        [[0.0, 0.0], [reach * math.sin(arc), reach * math.cos(arc)]],
        mass=[math.inf, 1.0],
        forces=[kg.Gravity(0.0, -GRAVITY)],
        restitution=0.0,
        tick_rate=tick_rate,
        allow_overlap=True,
    )
    energy = world.energy
    touched, left = 0.0, 0
    while left < 100:
        hits = world.collisions
        world.step()
        left = 0 if world.collisions > hits else left + 1
        if left == 0:
            touched = world.position[1, 1] / np.hypot(*world.position[1])
    assert touched == pytest.approx(2 / 3 * math.cos(arc), abs=0.01)
    assert energy - 0.01 < world.energy <= energy + 1e-9
