"""Balls at a packing fraction, with and without gravity: what crowding does to energy and to room."""

from __future__ import annotations

from kuglice.lab.running import Make
from kuglice.lab.work_precision.errors import long_run
from kuglice.scene import Gravity
from kuglice.scenes import gas

__all__ = ["COUNT", "drift", "sinking"]

COUNT = 200
WEIGHT = 10.0
"""Gravity; the balls start at speed 5."""


def drift(make: Make, packing: float, seconds: float) -> float:
    """Relative drift of energy of a gas."""
    scene = gas(n=COUNT, packing=packing)
    return long_run(scene, make(scene), seconds)[0]


def sinking(make: Make, packing: float, seconds: float) -> float:
    """Deepest overlap under gravity, in radii."""
    scene = gas(n=COUNT, packing=packing).model_copy(update={"forces": (Gravity(0.0, -WEIGHT),)})
    return long_run(scene, make(scene), seconds)[1]
