"""Very unequal masses: counts and velocities are exact at ratios that break solvers by iteration."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stability.worlds import make


def billiard(ratio: float, contacts: str, tick_rate: float):
    """A light ball between a wall and a heavy one that comes in: nothing else happens on the line."""
    return make(
        [[1.0, 5.0], [3.0, 5.0]],
        [[0.0, 0.0], [-1.0, 0.0]],
        mass=[1.0, ratio],
        box=(0, 0, 100, 10),
        tick_rate=tick_rate,
        contacts=contacts,
    )


@pytest.mark.parametrize("digits", range(6))
@pytest.mark.parametrize("tick_rate", [0.1, 60.0])
def test_galperins_billiard_counts_the_digits_of_pi(digits, tick_rate):
    # With masses 1 : 100^d there are floor(pi 10^d) hits, of the wall and of each other (Galperin 2003,
    # doi 10.1070/RD2003v008n04ABEH000252).
    world = billiard(100.0**digits, "event", tick_rate)
    energy = world.energy
    world.run(math.ceil(10 * tick_rate))
    assert world.collisions + world.wall_hits == int(math.pi * 10**digits)
    assert world.velocity[1, 0] >= world.velocity[0, 0] >= 0
    assert world.energy == pytest.approx(energy, rel=1e-10)


def test_overlap_counts_other_digits():
    world = billiard(1e8, "overlap", 60.0)
    world.run(600)
    assert world.collisions + world.wall_hits < 3141


@pytest.mark.parametrize("contacts", ["overlap", "backtrack", "event"])
@given(power=st.floats(-8, 8), speed=st.floats(0.1, 10))
def test_a_pair_at_any_ratio_to_1e8(contacts, power, speed):
    # u1' = (u1 (m1 - m2) + 2 m2 u2) / (m1 + m2) and the same with the balls swapped.
    first, second = 1.0, 10.0**power
    world = make(
        [[0.0, 0.0], [1.05, 0.0]],
        [[speed, 0.0], [0.0, 0.0]],
        mass=[first, second],
        tick_rate=60.0,
        contacts=contacts,
    )
    world.run(60)
    assert world.collisions == 1
    expected = speed * np.array([first - second, 2 * first]) / (first + second)
    assert world.velocity[:, 0] == pytest.approx(expected, rel=1e-13, abs=1e-15 * speed)


def test_a_speck_among_boulders_keeps_the_energy():
    # 1e-8 to 1: the speck has bounced hundreds of times before the boulders notice.
    random = np.random.default_rng(3)
    place = np.stack(np.meshgrid(np.arange(4) * 2.0 + 1.5, np.arange(4) * 2.0 + 1.5), axis=-1).reshape(-1, 2)
    place = np.concatenate([place, [[2.5, 2.5]]])
    velocity = random.normal(size=place.shape)
    mass = np.array([1.0] * 16 + [1e-8])
    radius = np.array([0.8] * 16 + [0.05])
    world = make(place, velocity, radius=radius, mass=mass, box=(0, 0, 9, 9))
    energy = world.energy
    world.run(600)
    assert world.energy == pytest.approx(energy, rel=1e-12)
    assert len(world.overlapping()) == 0
