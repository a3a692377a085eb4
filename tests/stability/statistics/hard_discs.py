"""What theory says of hard discs (diameter 1, mass 1, kT 1), and a gas of them between walls to ask."""

from __future__ import annotations

import math

import numpy as np

import kuglice as kg

REDUCED_VIRIALS = (
    1.0,
    4 / 3 - math.sqrt(3) / math.pi,
    0.5322318,
    0.33355604,
    0.1988425,
    0.1148728,
    0.0649930,
    0.0362193,
    0.0199537,
)
"""B_k / B_2^(k - 1) for k = 2 to 10; Clisby and McCoy, J. Stat. Phys. 122, 15 (2006)."""


def compressibility(packing: float) -> float:
    """Z = pressure x area / (N kT), by ten virial coefficients: good for packings up to 0.3."""
    return 1 + sum(b * (2 * packing) ** k for k, b in enumerate(REDUCED_VIRIALS, start=1))


def collisions_per_disc_and_time(packing: float) -> float:
    """Enskog's rate, exact if its contact value g of the pair distribution is: Z - 1 = 2 packing g."""
    return 4 / math.sqrt(math.pi) * (compressibility(packing) - 1)


def relative_speed_in_closed_box(count: int) -> float:
    """Mean relative speed of `count` discs that share a fixed energy, over that of an open (canonical) gas.

    All velocities are a point on a sphere in 2 n dimensions, a relative velocity is two coordinates of it.
    """
    return math.sqrt(count) * math.exp(math.lgamma(count) - math.lgamma(count + 0.5))


def accessible_side(count: int, packing: float) -> float:
    """Side of the square that the centres can reach, if `packing` is counted on its area."""
    return math.sqrt(count * math.pi / 4 / packing)


def gas(rows: int, packing: float, seed: int) -> kg.World:
    """rows^2 discs in equilibrium: a lattice molten for 30 collisions per disc. A tick is 1 time unit."""
    count = rows * rows
    side = accessible_side(count, packing)
    random = np.random.default_rng(seed)
    lattice = 0.5 + (np.arange(rows) + 0.5) * side / rows
    velocity = random.normal(size=(count, 2))
    velocity *= np.sqrt(2 * count / (velocity**2).sum())
    scene = kg.Scene(
        box=(0.0, 0.0, side + 1, side + 1),
        balls=kg.Balls(
            position=np.stack(np.meshgrid(lattice, lattice), axis=-1).reshape(-1, 2),
            velocity=velocity,
            radius=0.5,
            mass=1.0,
        ),
        tick_rate=1.0,
    )
    world = kg.World(scene, kg.Model(integrator="verlet", contacts="event", broadphase="loose_quadtree"))
    while 2 * world.collisions < 30 * count:
        world.step()
    return world
