"""Balls of very different sizes."""

from __future__ import annotations

import math

from kuglice.balls import PI
from kuglice.layout import RandomGroup
from kuglice.scene import Scene
from kuglice.scenes.bounds import at_least, positive, whole

__all__ = ["mixed"]

SMALLEST, LARGEST = 0.1, 2.0


def mixed(n: int = 1200, packing: float = 0.35, seed: int = 1, speed: float = 4.0) -> Scene:
    """n elastic balls of radii 0.1 to 2, and so of masses 1 to 400, at a packing fraction."""
    whole("mixed", n=n)
    whole("mixed", least=0, most=None, seed=seed)
    positive("mixed", packing=packing)
    at_least("mixed", 0.0, speed=speed)
    # The mean of radius^2 for radii spread evenly.
    mean_square = (LARGEST**3 - SMALLEST**3) / (3.0 * (LARGEST - SMALLEST))
    height = math.sqrt(n * PI * mean_square / packing * 9.0 / 16.0)
    return Scene(
        title="Mixed",
        description="Radii from 0.1 to 2: in the long run small balls are fast and large ones slow.",
        box=(0.0, 0.0, height * 16.0 / 9.0, height),
        groups=(RandomGroup(count=n, radius=(SMALLEST, LARGEST), speed=speed, seed=seed),),
    )
