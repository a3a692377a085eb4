"""Ploughs round and round the middle of the box."""

from __future__ import annotations

import math

import numpy as np

from kuglice.inputs import Input
from kuglice_client.bots.sight import Sight

__all__ = ["orbiter"]

ROUND_SECONDS = 7.0
SHARE_OF_BOX = 0.33


def orbiter(sight: Sight) -> Input | None:
    """Follows a point on an ellipse, a sixteenth of a round ahead of where it is itself."""
    if sight.index is None:
        return None
    lower, upper = sight.box
    middle, half = (lower + upper) / 2, (upper - lower) * SHARE_OF_BOX
    here = (sight.positions[sight.index] - middle) / half
    angle = math.atan2(here[1], here[0]) + math.pi / 8
    aim = middle + half * np.array([math.cos(angle), math.sin(angle)]) - sight.positions[sight.index]
    distance = float(np.hypot(*aim))
    if distance == 0:
        return None
    speed = 2 * math.pi * float(half.mean()) / ROUND_SECONDS
    return sight.towards(aim * (speed / distance), seconds=0.3)
