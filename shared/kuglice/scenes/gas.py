"""Gas in a box."""

from __future__ import annotations

import math

from kuglice.balls import PI
from kuglice.layout import RandomGroup
from kuglice.scene import Scene
from kuglice.scenes.bounds import at_least, fraction_of_area, positive, whole

__all__ = ["gas"]

DENSEST = PI / math.sqrt(12.0)
"""Of equal discs, in rows that touch."""


def gas(n: int = 1000, packing: float = 0.3, seed: int = 1, radius: float = 0.5, speed: float = 5.0) -> Scene:
    """n equal elastic balls at a packing fraction, in a box of 16:9, all of one speed at first."""
    whole("gas", n=n)
    whole("gas", least=0, most=None, seed=seed)
    fraction_of_area("gas", DENSEST, packing=packing)
    positive("gas", radius=radius)
    at_least("gas", 0.0, speed=speed)
    height = math.sqrt(n * PI * radius * radius / packing * 9.0 / 16.0)
    width = height * 16.0 / 9.0
    return Scene(
        title="Gas",
        description="Equal speeds at the start turn into Maxwell's distribution while the energy stays.",
        box=(0.0, 0.0, width, height),
        groups=(RandomGroup(count=n, radius=radius, speed=speed, seed=seed),),
    )
