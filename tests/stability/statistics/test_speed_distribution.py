"""A few discs share a fixed energy: shares are Beta(1, n - 1), not Maxwell and Boltzmann's."""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from stability.statistics.estimate import of_blocks

COUNT = 8
BLOCKS = 40
SAMPLES = 2500
MASSES = {"equal": np.ones(COUNT), "unequal": np.geomspace(0.2, 5.0, COUNT)}


@pytest.fixture(scope="module", params=MASSES)
def shares(request):
    """(blocks, samples, balls): each ball's share of the energy, about two collisions per ball apart."""
    mass = MASSES[request.param]
    random = np.random.default_rng(8)
    place = np.array([(x, y) for x in (1.0, 2.5, 4.0) for y in (1.0, 2.5, 4.0)])[:COUNT]
    scene = kg.Scene(
        box=(0.0, 0.0, 5.0, 5.0),
        balls=kg.Balls(position=place, velocity=random.normal(size=(COUNT, 2)), radius=0.5, mass=mass),
        tick_rate=0.5,
    )
    world = kg.World(scene, kg.Model(integrator="verlet", contacts="event", broadphase="brute"))
    world.run(100)
    taken = np.empty((BLOCKS, SAMPLES, COUNT))
    for sample in taken.reshape(-1, COUNT):
        world.step()
        energy = mass * (world.velocity**2).sum(axis=1) / 2
        sample[:] = energy / energy.sum()
    assert world.collisions > taken.size / 2
    return taken


def test_each_ball_has_the_same_mean_energy_whatever_its_mass(shares):
    for ball in range(COUNT):
        assert of_blocks(shares[..., ball].mean(axis=1)).sigmas(1 / COUNT) < 3.5


def test_fourth_moment_is_that_of_a_closed_gas(shares):
    # <v^4> / <v^2>^2 = 2 n / (n + 1), which is 2 only for infinitely many.
    ratio = of_blocks((COUNT**2 * shares**2).mean(axis=(1, 2)))
    assert ratio.sigmas(2 * COUNT / (COUNT + 1)) < 3
    assert ratio.sigmas(2.0) > 10


@pytest.mark.parametrize("share", [0.05, 0.1, 0.2, 0.3, 0.5])
def test_distribution_is_beta(shares, share):
    above = of_blocks((shares > share).mean(axis=(1, 2)))
    assert above.sigmas((1 - share) ** (COUNT - 1)) < 3
