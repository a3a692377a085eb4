"""Planets around an attractor."""

from __future__ import annotations

import math

from kuglice.layout import ListedGroup
from kuglice.scene import Attractor, Balls, Scene
from kuglice.scenes.bounds import at_least, positive, whole

__all__ = ["orbit"]


def orbit(n: int = 12, strength: float = 200.0, softening: float = 0.1) -> Scene:
    """n small balls on circles of different radii; none ever meets another."""
    whole("orbit", n=n)
    at_least("orbit", 0.0, strength=strength)
    positive("orbit", softening=softening)
    position, velocity = [], []
    for index in range(n):
        distance = 2.0 + index
        # Rational points of the unit circle: sin and cos are not the same on every platform.
        t = (5 * index % 7 - 3) / 3.0
        x, y = (1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)
        squared = distance * distance + softening * softening
        speed = distance * math.sqrt(strength / (squared * math.sqrt(squared)))
        position.append((x * distance, y * distance))
        velocity.append((-y * speed, x * speed))
    half = n + 4.0
    return Scene(
        title="Orbit",
        description="Circular orbits without collisions: what an integrator gains or loses is plain to see.",
        box=(-half * 16.0 / 9.0, -half, half * 16.0 / 9.0, half),
        forces=(Attractor(0.0, 0.0, strength, softening),),
        groups=(ListedGroup(balls=Balls(position=position, velocity=velocity, radius=0.25)),),
        # Whoever looks at orbits looks for what a cheap integrator does to them.
        accuracy="faithful",
    )
