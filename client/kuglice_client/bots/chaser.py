"""Runs after the nearest rival, or after the fastest ball if it is alone."""

from __future__ import annotations

import numpy as np

from kuglice.inputs import Input
from kuglice_client.bots.sight import Sight

__all__ = ["chaser"]

LOOKAHEAD_SECONDS = 0.4
BOX_CROSSING_SECONDS = 3.5


def chaser(sight: Sight) -> Input | None:
    """Heads for where its prey will be."""
    if sight.index is None:
        return None
    here = sight.positions[sight.index]
    if sight.rivals:
        prey = min(sight.rivals, key=lambda row: float(np.hypot(*(sight.positions[row] - here))))
    else:
        speeds = np.hypot(*sight.velocities.T)
        speeds[sight.index] = -1.0
        prey = int(speeds.argmax())
    lower, upper = sight.box
    aim = np.clip(sight.positions[prey] + LOOKAHEAD_SECONDS * sight.velocities[prey], lower, upper) - here
    distance = float(np.hypot(*aim))
    if distance == 0:
        return None
    speed = float(np.hypot(*(upper - lower))) / BOX_CROSSING_SECONDS
    return sight.towards(aim * (speed / distance), seconds=0.25)
