"""How wrong an integrator is per radian (or decay time) of one ball, by step, against the formula.

A force that depends on place: a spring, x = cos(t); an orbit, (cos(t), sin(t)), whose period depends on its size, so
that errors grow faster. On velocity: drag, x = 1 - exp(-t). On neither: gravity, x = t^2 / 2. Errors are relative to
the amplitude: a / omega^2, v / gamma, a t^2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from kuglice.model import Model
from kuglice.scene import Attractor, Balls, Drag, Gravity, Scene, Spring
from kuglice.scene.forces import Force
from kuglice.world import World

__all__ = ["KINDS", "force_error"]


class Motion(NamedTuple):
    """A ball of mass 1 whose path is known."""

    force: Force
    place: float
    velocity: tuple[float, float]
    time: int
    right: tuple[float, float]


ROUND = 6
"""Radians: most of an orbit."""
KINDS: dict[str, Motion] = {
    "spring": Motion(Spring(0.0, 0.0, 1.0), 1.0, (0.0, 0.0), 1, (math.cos(1.0), 0.0)),
    "orbit": Motion(
        Attractor(0.0, 0.0, 1.0, 1e-9), 1.0, (0.0, 1.0), ROUND, (math.cos(ROUND), math.sin(ROUND))
    ),
    "velocity": Motion(Drag(1.0), 0.0, (1.0, 0.0), 1, (1.0 - math.exp(-1.0), 0.0)),
    "uniform": Motion(Gravity(1.0, 0.0), 0.0, (0.0, 0.0), 1, (0.5, 0.0)),
}


def force_error(integrator: str, kind: str, steps: int) -> float:
    """With `steps` steps in each unit of time; per unit."""
    motion = KINDS[kind]
    scene = Scene(
        box=(-9.0, -9.0, 9.0, 9.0),
        walls=False,
        tick_rate=float(steps),
        forces=(motion.force,),
        balls=Balls(position=[(motion.place, 0.0)], velocity=[motion.velocity], radius=0.1, mass=1.0),
    )
    world = World(scene, Model(integrator=integrator, contacts="overlap", broadphase="brute"))
    world.run(motion.time * steps)
    return math.dist(world.position[0].tolist(), motion.right) / motion.time
