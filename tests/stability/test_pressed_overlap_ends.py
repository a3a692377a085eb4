"""Regression: under a force that varies, `event` never finished a tick with an overlapping, pressed pair.

A player joined on top of a ball and thrust into it. The contact was held (supported), rounding left an approach of
1e-16, that bounced, the bounce dropped the support, and so on until the limit of events: the server ended. A contact
that bears is now left alone until one of its balls is struck.
"""

import numpy as np
import pytest

import kuglice as kg

EVENT = kg.Model(integrator="verlet", contacts="event", broadphase="brute")


@pytest.mark.parametrize("thrust", [(250, 0), (241, 64), (125, -216), (176, -176), (216, -125), (100, 0)])
def test_a_player_inside_a_ball_may_thrust_into_it(thrust):
    scene = kg.Scene(
        box=(0, 0, 64, 36),
        balls=kg.Balls(position=[[3.24, 26.66]], velocity=[[0.76, 0.085]], radius=0.585, mass=1.07),
        forces=[kg.ThrustForce(), kg.AttractForce(softening=2.0), kg.Drag(coefficient=0.08)],
        limits=kg.InputLimits(thrust=250.0),
    )
    world = kg.World(scene, EVENT)
    world.step([kg.Join(client=1, sequence=1, x=2.0, y=27.0, radius=1.2, mass=8.0)])
    world.step([kg.Thrust(client=1, sequence=2, x=thrust[0], y=thrust[1])])
    world.run(120)
    assert world.collisions < 1000


@pytest.mark.parametrize("seed", range(15))
def test_a_crowd_that_starts_overlapped_round_an_attractor(seed):
    random = np.random.default_rng(seed)
    scene = kg.Scene(
        box=(0, 0, 20, 10),
        balls=kg.Balls(
            position=random.uniform([2, 2], [18, 8], (20, 2)),
            velocity=random.normal(size=(20, 2)),
            radius=random.uniform(0.3, 0.9, 20),
        ),
        forces=[kg.Attractor(x=10, y=5, strength=200, softening=1.0)],
        allow_overlap=True,
    )
    world = kg.World(scene, EVENT)
    world.run(120)
    assert np.isfinite(world.energy)
