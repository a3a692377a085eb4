"""Carries a point that attracts all balls through the box; lets go now and then, so that they scatter."""

from __future__ import annotations

import math

import numpy as np

from kuglice.inputs import Attract, Input
from kuglice_client.bots.sight import Sight

__all__ = ["herder"]

ROUND_SECONDS = 6.0
HOLD_SECONDS, REST_SECONDS = 3.0, 1.0
SHARE_OF_BOX = 0.3


def herder(sight: Sight) -> Input | None:
    """A figure of eight, held for three seconds of every four."""
    limit = sight.world.scene.limits.attract
    if limit is None:
        return None
    lower, upper = sight.box
    angle = 2 * math.pi * sight.time / ROUND_SECONDS
    point = (lower + upper) / 2 + (upper - lower) * SHARE_OF_BOX * np.array(
        [math.sin(angle), math.sin(2 * angle)]
    )
    holding = sight.time % (HOLD_SECONDS + REST_SECONDS) < HOLD_SECONDS
    return Attract(x=float(point[0]), y=float(point[1]), strength=limit if holding else 0.0)
