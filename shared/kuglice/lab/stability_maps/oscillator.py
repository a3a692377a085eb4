"""A ball on a spring: what an integrator does to its energy, per step, over omega * dt."""

from __future__ import annotations

import math

from kuglice.errors import StepError
from kuglice.model import Model
from kuglice.scene import Balls, Scene, Spring
from kuglice.world import World

__all__ = ["BOUNDARY", "growth", "theory"]

BOUNDARY = {"symplectic_euler": 2.0, "verlet": 2.0, "rk4": 2.0 * math.sqrt(2.0)}
"""omega * dt up to which energy stays bounded; explicit Euler has none."""
STEPS = 200


def growth(integrator: str, step: float) -> float:
    """Energy after STEPS steps of omega * dt = `step`, relative to that at the start; inf if it overflows."""
    scene = Scene(
        box=(-1.0, -1.0, 1.0, 1.0),
        walls=False,
        tick_rate=1.0 / step,
        forces=(Spring(0.0, 0.0, 1.0),),
        balls=Balls(position=[(0.5, 0.0)], radius=0.1, mass=1.0),
    )
    world = World(scene, Model(integrator=integrator, contacts="overlap", broadphase="brute"))
    start = world.energy
    try:
        world.run(STEPS)
    except StepError:
        return math.inf
    return world.energy / start


def theory(integrator: str, step: float) -> float:
    """The same by the squared modulus of the largest amplification factor.

    Explicit Euler: 1 + z^2. RK4: |1 + iz - z^2/2 - iz^3/6 + z^4/24|^2. Symplectic schemes: 1 up to z = 2, beyond
    it the square of the larger root of s^2 - (2 - z^2) s + 1.
    """
    square = step * step
    match integrator:
        case "euler":
            factor = 1.0 + square
        case "rk4":
            real, imaginary = 1.0 - square / 2.0 + square * square / 24.0, step - step * square / 6.0
            factor = real * real + imaginary * imaginary
        case _:
            half = (2.0 - square) / 2.0
            factor = 1.0 if abs(half) <= 1.0 else (abs(half) + math.sqrt(half * half - 1.0)) ** 2
    # An exponent beyond this is infinity as far as anybody can draw.
    return math.exp(min(STEPS * math.log(factor), 700.0))
