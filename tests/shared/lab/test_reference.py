"""The lab measures errors against a reference of its own; here that reference is held to the oracle and to formulas."""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from kuglice.lab.methods import Method
from kuglice.lab.reference import reference, seconds_until
from kuglice.lab.work_precision import TABLE
from kuglice.lab.work_precision.errors import position_error
from oracle.layout import gas as oracle_gas


@pytest.mark.parametrize("gravity", [(0.0, 0.0), (0.3, -1.0)])
@pytest.mark.parametrize("packing", [0.1, 0.4])
def test_is_the_oracle_to_rounding_where_balls_fly_on_parabolas(packing, gravity):
    start = oracle_gas(3, 24, packing, unequal=True, gravity=gravity)
    scene = kg.Scene(
        box=start.box,
        balls=kg.Balls(
            position=start.position, velocity=start.velocity, radius=start.radius, mass=start.mass
        ),
        forces=[kg.Gravity(*gravity)] if any(gravity) else [],
        tick_rate=64.0,
    )
    seconds, _ = seconds_until(scene, 1.0, 4.0, 1 / 64)
    world, oracle = reference(scene), start.oracle(160)
    world.run(round(seconds * 64))
    oracle.run_to(world.time)
    assert oracle.collisions > 0
    assert position_error(world.position, oracle.position.astype(float), start.radius) < 1e-9


def test_is_an_exact_orbit():
    """The inmost planet: after any time, (cos, sin) of the angle that its own speed gives."""
    scene = kg.scenes.orbit(n=3)
    world = reference(scene, collisions=False)
    world.run(60)
    start, speed = scene.balls.position, np.sqrt((scene.balls.velocity**2).sum(1))
    distance = np.sqrt((start**2).sum(1))
    turned = np.arctan2(start[:, 1], start[:, 0]) + speed / distance
    right = distance[:, None] * np.column_stack([np.cos(turned), np.sin(turned)])
    assert position_error(world.position, right, scene.balls.radius) < 1e-9


@pytest.mark.parametrize("name", ["swarm", "drag"])
def test_is_far_more_accurate_than_what_is_measured(name):
    """Of itself it can only be shown that twice as fine makes little difference."""
    scene = TABLE[name].make(1).model_copy(update={"tick_rate": 480.0})
    ticks = round(480 * seconds_until(scene, 1.0, 1.0, 1 / 30)[0])
    found = []
    for world in (
        reference(scene),
        reference(scene, finer=128),
        kg.World(scene, Method("verlet", "event").model()),
    ):
        world.run(ticks)
        found.append(world.position)
    fine, finer, measured = found
    radius = scene.balls.radius
    assert position_error(fine, finer, radius) < 0.05 * position_error(measured, finer, radius)


def test_a_window_ends_with_the_wanted_collision():
    scene = kg.scenes.gas(n=100)
    seconds, collisions = seconds_until(scene, 1.0, 10.0, 1 / 60)
    before, _ = seconds_until(scene, 1.0, seconds - 1 / 60, 1 / 60)
    assert 2 * collisions >= 100
    assert before < seconds < 1.0


def test_a_window_without_collisions_ends_in_time():
    assert seconds_until(kg.scenes.orbit(), 1.0, 0.5, 1 / 60) == (pytest.approx(0.5), 0)
