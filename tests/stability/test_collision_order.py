"""Collisions at the end of a tick cap any integrator at first order; collisions at their times restore it.

A hit found up to a tick late is a time error of order dt, whatever the integrator does between hits.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import kuglice as kg
from stability.harmonic import reflected
from stability.orders import order
from stability.worlds import make

OMEGA = 2.0
DURATION = 4.0
TICKS = [256, 512, 1024, 2048]
RADIUS = 0.5
STARTS = np.linspace(1.3, 2.3, 24)
"""Lateness is a sawtooth of the start: errors are the root mean square over many."""

METHODS = {
    ("euler", "overlap"): 1,
    ("symplectic_euler", "overlap"): 1,
    ("verlet", "overlap"): 1,
    ("rk4", "overlap"): 1,
    ("verlet", "event"): 2,
}

methods = pytest.mark.parametrize(("integrator", "contacts"), METHODS)


def measured(world_of, exact_of, integrator, contacts) -> tuple[float, list[float]]:
    """Order, and the errors of the last ball's place."""
    exact = [exact_of(start) for start in STARTS]
    assert all(hits >= 2 for _, _, hits in exact)
    errors = []
    for ticks in TICKS:
        apart = []
        for start, (place, _, _) in zip(STARTS, exact, strict=True):
            world = world_of(start, integrator=integrator, contacts=contacts, tick_rate=ticks / DURATION)
            world.run(ticks)
            apart.append(world.position[-1] - place)
        errors.append(math.sqrt(np.mean(np.square(apart))))
    return order(TICKS, errors), errors


def above_a_floor(centre: float):
    """A ball that a spring to `centre` above its place of contact throws on a floor, and its path."""
    middle = np.array([0.0, centre + RADIUS])

    def world(start, **method):
        spring = kg.Spring(*middle, OMEGA**2)
        return make([[0.0, start + RADIUS]], radius=RADIUS, box=(-5, 0, 5, 40), forces=[spring], **method)

    def exact(start):
        return reflected(
            np.array([0.0, start + RADIUS]),
            np.zeros(2),
            centre=middle,
            omega=OMEGA,
            duration=DURATION,
            gap=lambda p: p[1] - RADIUS,
            normal=lambda p: np.array([0.0, 1.0]),
        )

    return world, exact


@methods
@pytest.mark.parametrize("centre", [-1.0, 0.5])
def test_a_kicked_ball_on_a_floor(integrator, contacts, centre):
    found, _ = measured(*above_a_floor(centre), integrator, contacts)
    assert found == pytest.approx(METHODS[integrator, contacts], abs=0.35)


def test_a_better_integrator_buys_nothing_and_better_contacts_two_digits():
    scene = above_a_floor(-1.0)
    _, verlet = measured(*scene, "verlet", "overlap")
    _, rk4 = measured(*scene, "rk4", "overlap")
    _, event = measured(*scene, "verlet", "event")
    assert rk4 == pytest.approx(verlet, rel=0.01)
    assert event[0] < verlet[-1] / 5
    assert all(e < v / 50 for e, v in zip(event, verlet, strict=True))


@pytest.mark.parametrize("tick_rate", [1.0, 16.0, 1000.0])
def test_a_pair_of_equal_balls_in_one_well(tick_rate):
    # Masses are equal: x1 + x2 swings freely, x2 - x1 swings and is reflected at r1 + r2. Verlet's frequency
    # is off: sin(w h / 2) = omega h / 2, from the trace of its matrix.
    h, omega = 1 / tick_rate, 0.5
    world = make(
        [[-1.0, 0.0], [2.0, 0.0]], forces=[kg.Spring(0.0, 0.0, omega**2)], tick_rate=tick_rate, radius=0.25
    )
    start = world.energy
    world.run(round(10 * tick_rate))
    middle = world.position[:, 0].sum()
    frequency = 2 * math.asin(omega * h / 2) / h
    assert middle == pytest.approx(1.0 * math.cos(frequency * 10), abs=1e-12)
    assert world.collisions == 2
    # A hit inside a kicked tick leaves an error of energy of second order in omega h; there are two.
    assert world.energy == pytest.approx(start, rel=4 * (omega * h) ** 2)


@methods
def test_a_kicked_ball_on_a_peg(integrator, contacts):
    # Oblique hits: a peg of radius 0.5 beside the spring's centre.
    middle, peg = np.array([0.0, 0.0]), np.array([0.3, -0.4])

    def world(start, **method):
        return make([peg, [start, start]], mass=[math.inf, 1.0], forces=[kg.Spring(0, 0, OMEGA**2)], **method)

    def exact(start):
        return reflected(
            np.array([start, start]),
            np.zeros(2),
            centre=middle,
            omega=OMEGA,
            duration=DURATION,
            gap=lambda p: math.dist(p, peg) - 2 * RADIUS,
            normal=lambda p: (p - peg) / math.dist(p, peg),
        )

    found, _ = measured(world, exact, integrator, contacts)
    assert found == pytest.approx(METHODS[integrator, contacts], abs=0.35)
