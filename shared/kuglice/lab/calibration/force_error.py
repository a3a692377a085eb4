"""How wrong an integrator is after one radian (or one decay time) of one ball, by step, against the formula.

A force that depends on place: a spring, x = cos(t). On velocity: drag, x = 1 - exp(-t). On neither: gravity,
x = t^2 / 2. Errors are relative to the amplitude: a / omega^2, v / gamma, a t^2.
"""

from __future__ import annotations

import math

from kuglice.model import Model
from kuglice.scene import Balls, Drag, Gravity, Scene, Spring
from kuglice.scene.forces import Force
from kuglice.world import World

__all__ = ["KINDS", "force_error"]

KINDS: dict[str, tuple[Force, float, float, float]] = {
    "place": (Spring(0.0, 0.0, 1.0), 1.0, 0.0, math.cos(1.0)),
    "velocity": (Drag(1.0), 0.0, 1.0, 1.0 - math.exp(-1.0)),
    "uniform": (Gravity(1.0, 0.0), 0.0, 0.0, 0.5),
}
"""Kind -> force, place and velocity at the start, place at time 1."""


def force_error(integrator: str, kind: str, steps: int) -> float:
    """After `steps` steps of 1 / steps each."""
    force, place, velocity, right = KINDS[kind]
    scene = Scene(
        box=(-9.0, -9.0, 9.0, 9.0),
        walls=False,
        tick_rate=float(steps),
        forces=(force,),
        balls=Balls(position=[(place, 0.0)], velocity=[(velocity, 0.0)], radius=0.1, mass=1.0),
    )
    world = World(scene, Model(integrator=integrator, contacts="overlap", broadphase="brute"))
    world.run(steps)
    return abs(float(world.position[0, 0]) - right)
