"""A column of balls weighs what its balls weigh: floor minus ceiling force is N m g, at any density."""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from stability.statistics.estimate import of_blocks
from stability.statistics.wall_impulses import WallImpulses

GRAVITY = (0.0, -0.25)
BLOCKS = 20
TIME = 40.0
EVENT = kg.Model(integrator="verlet", contacts="event", broadphase="quadtree")


def column(rows, width, height):
    """4 x rows balls of mixed masses, radius 0.5, in a box so low that some reach the ceiling."""
    random = np.random.default_rng(rows)
    x, y = (np.arange(4) + 0.5) * width / 4, (np.arange(rows) + 0.5) * height / rows
    count = 4 * rows
    mass = np.exp(random.uniform(np.log(0.5), np.log(2.0), count))
    scene = kg.Scene(
        box=(0.0, 0.0, width, height),
        balls=kg.Balls(
            position=np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2),
            velocity=random.normal(size=(count, 2)) / np.sqrt(mass)[:, None],
            radius=0.5,
            mass=mass,
        ),
        forces=[kg.Gravity(x=GRAVITY[0], y=GRAVITY[1])],
        tick_rate=1.0,
    )
    return kg.World(scene, EVENT)


@pytest.mark.parametrize(("rows", "width", "height"), [(6, 8.0, 12.0), (6, 5.0, 7.5)], ids=["thin", "dense"])
def test_floor_carries_the_weight_and_what_the_ceiling_pushes_down(rows, width, height):
    world = column(rows, width, height)
    world.run(50)
    weight = -world.mass.sum() * GRAVITY[1]
    momentum = world.momentum[1]
    walls = WallImpulses(world, GRAVITY, alone=True)
    floor, ceiling = np.zeros(BLOCKS), np.zeros(BLOCKS)
    for block in range(BLOCKS):
        for _, up in walls.during(TIME, longest_step=0.05):
            floor[block] += max(up, 0) / TIME
            ceiling[block] += max(-up, 0) / TIME
    assert ceiling.sum() * TIME > 50, "the ceiling is to have a say"
    difference = of_blocks(floor - ceiling)
    assert difference.sigmas(weight) < 3
    assert difference.error < 0.02 * weight
    # Beyond statistics: what the walls and gravity gave is what the balls have.
    gained = world.momentum[1] - momentum
    assert (floor - ceiling - weight).sum() * TIME == pytest.approx(gained, abs=1e-9 * weight * TIME * BLOCKS)


def test_one_bouncing_ball_spends_a_third_of_its_energy_on_motion():
    # Thrown sideways it would change nothing; time averages of a parabola are 1/3 kinetic, 2/3 potential.
    scene = kg.Scene(
        box=(0.0, 0.0, 4.0, 10.0),
        balls=kg.Balls(position=[(2.0, 5.5)], velocity=[(0.0, 0.0)], radius=0.5, mass=3.0),
        forces=[kg.Gravity(x=0.0, y=-10.0)],
        tick_rate=64.0,
    )
    world = kg.World(scene, EVENT)
    kinetic = []
    for _ in range(64 * 200):
        world.step()
        kinetic.append(world.kinetic_energy)
    # 200 s are 100 hops of 2 s, of 128 samples each.
    assert world.wall_hits == 100
    assert np.mean(kinetic) == pytest.approx(3.0 * 10.0 * 5.0 / 3, rel=1e-3)
