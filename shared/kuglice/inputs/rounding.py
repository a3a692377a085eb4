"""Inputs whose numbers take two bytes on the wire: binary16 is finer than any hand, and the wire is exact anyway."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

import numpy as np

from kuglice.inputs.kinds import Attract, Input, Kick, Thrust

if TYPE_CHECKING:
    from kuglice.scene import Scene

__all__ = ["rounded"]


def rounded(given: Input, scene: Scene) -> Input:
    """The input with forces, strengths, kicks and points of attraction in binary16; others as they are.

    The relative error is at most 1/1024 where the number is not smaller than 6e-5. Forces, strengths and kicks are
    rounded towards 0 and points towards the middle of the box, so that what was within its bounds stays there.
    """
    left, bottom, right, top = scene.box
    towards: dict[str, float]
    match given:
        case Thrust():
            towards = {"x": 0.0, "y": 0.0}
        case Kick():
            towards = {"vx": 0.0, "vy": 0.0}
        case Attract():
            towards = {"x": (left + right) / 2, "y": (bottom + top) / 2, "strength": 0.0}
        case _:
            return given
    numbers = {name: _rounded(getattr(given, name), aim) for name, aim in towards.items()}
    changed: Input = given.model_copy(update=numbers)
    return changed


def _rounded(number: float, towards: float) -> float:
    try:
        (half,) = struct.unpack("<e", struct.pack("<e", number))
    except OverflowError:
        return number
    low, high = min(number, towards), max(number, towards)
    if not low <= half <= high:
        half = float(np.nextafter(np.float16(half), np.float16(towards)))
    # In a box smaller than the distance of two such numbers there may be none.
    return half if low <= half <= high else number
