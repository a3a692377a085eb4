"""What passes through what: head-on pairs, and balls against walls, pegs and each other at absurd speeds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stability.worlds import make

PAIRS = 1000
RADII = (0.2, 0.3)
REACH = sum(RADII)


def seen(contacts: str, moves: float) -> float:
    """Share of head-on pairs that collide, over all phases, if a tick moves them `moves` (r1 + r2) nearer."""
    # Pair i has a row of its own and meets i / PAIRS of a tick after a tick began.
    move = moves * REACH
    phase = (np.arange(PAIRS) + 0.5) / PAIRS
    y = np.repeat(3.0 * np.arange(PAIRS), 2)
    x = np.zeros(2 * PAIRS)
    x[1::2] = REACH + move * (1 + phase)
    velocity = np.zeros((2 * PAIRS, 2))
    velocity[0::2, 0], velocity[1::2, 0] = 0.25 * move, -0.75 * move
    world = make(
        np.stack([x, y], axis=1), velocity, radius=np.tile(RADII, PAIRS), tick_rate=1.0, contacts=contacts
    )
    world.run(4)
    return world.collisions / PAIRS


SPEEDS = [0.1, 0.5, 0.999, 1.25, 2.0, 4.0, 10.0, 100.0]


@pytest.mark.parametrize("moves", SPEEDS)
def test_overlap_sees_as_much_of_a_tick_as_the_radii_cover(moves):
    # Seen while 0 < distance < r1 + r2 before the centres pass: that is (r1 + r2) / L of all phases.
    assert seen("overlap", moves) == pytest.approx(min(1.0, 1 / moves), abs=1.5 / PAIRS)


@pytest.mark.parametrize("moves", SPEEDS)
def test_backtrack_sees_twice_that(moves):
    # It judges the approach at the contact, so a pair that overlaps beyond its centres counts too.
    assert seen("backtrack", moves) == pytest.approx(min(1.0, 2 / moves), abs=1.5 / PAIRS)


@pytest.mark.parametrize("moves", [*SPEEDS, 1e3, 1e6])
def test_event_sees_all(moves):
    assert seen("event", moves) == 1.0


def test_at_a_million_times_the_radii_the_others_see_nothing():
    assert seen("overlap", 1e6) == seen("backtrack", 1e6) == 0.0


@given(
    moves=st.floats(1e-3, 1e4),
    impact=st.floats(-0.999, 0.999),
    masses=st.tuples(st.floats(0.01, 100), st.floats(0.01, 100)),
)
def test_event_turns_a_pair_as_the_formula_says_at_any_speed(moves, impact, masses):
    # b = impact (r1 + r2): the normal at contact is (sqrt(1 - impact^2), impact), m1 u1 + m2 u2 is kept.
    first, second = masses
    speed = moves * REACH
    world = make(
        [[0.0, 0.0], [REACH * math.sqrt(1 - impact**2) + 0.5 * speed, impact * REACH]],
        [[0.0, 0.0], [-speed, 0.0]],
        radius=RADII,
        mass=masses,
        tick_rate=1.0,
    )
    world.step()
    normal = np.array([math.sqrt(1 - impact**2), impact])
    pushed = -speed * normal[0] * normal * 2 / (first + second)
    expected = np.array([pushed * second, [-speed, 0.0] - pushed * first])
    assert world.collisions == 1
    # The root's discriminant is a difference of squares of the distance: its rounding grows with the square.
    rounding = 1e-15 * (1 + moves**2) / (1 - impact**2)
    assert world.velocity == pytest.approx(expected, abs=rounding * speed)


@pytest.mark.parametrize("contacts", ["overlap", "backtrack"])
def test_a_fast_ball_flies_through_a_peg_unless_event_stops_it(contacts):
    def after(contacts):
        world = make(
            [[0.0, 0.0], [-7.0, 0.0]],
            [[0.0, 0.0], [10.0, 0.0]],
            mass=[math.inf, 1.0],
            tick_rate=1.0,
            contacts=contacts,
        )
        world.run(2)
        return world.velocity[1, 0]

    assert after(contacts) == 10.0
    assert after("event") == -10.0


@given(speed=st.floats(1, 1e5), angle=st.floats(0, 2 * math.pi))
def test_event_keeps_a_fast_ball_in_its_box(speed, angle):
    # Thousands of bounces in a tick: x is the triangle wave of the free path, of period 2 (width - 2 r).
    radius, width = 0.25, 1.5
    start = np.array([0.6, 0.7])
    velocity = speed * np.array([math.cos(angle), math.sin(angle)])
    world = make(start[None], velocity[None], radius=radius, box=(0, 0, width, width), tick_rate=1.0)
    world.step()
    inner = width - 2 * radius
    phase = np.mod(start - radius + velocity, 2 * inner)
    expected = radius + np.minimum(phase, 2 * inner - phase)
    assert world.position[0] == pytest.approx(expected, abs=1e-13 * (1 + speed) ** 1.5)
    assert np.abs(world.velocity[0]) == pytest.approx(np.abs(velocity), rel=1e-15)
    assert world.wall_hits == pytest.approx(np.abs(velocity).sum() / inner, abs=3)


def test_overlap_lets_a_fast_ball_leave_the_box_for_a_while():
    world = make(
        [[0.5, 0.5]], [[50.0, 0.0]], radius=0.25, box=(0, 0, 1, 1), tick_rate=1.0, contacts="overlap"
    )
    world.step()
    assert world.position[0, 0] == 50.5
    world.step()
    assert world.position[0, 0] == 0.5
