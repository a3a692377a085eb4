"""Wanders from one quiet corner of the box to the next and keeps out of everybody's way."""

from __future__ import annotations

import numpy as np

from kuglice.inputs import Input
from kuglice_client.bots.sight import Sight

__all__ = ["drifter"]

CELLS = 4
BOX_CROSSING_SECONDS = 5.0


def drifter(sight: Sight) -> Input | None:
    """Heads for the middle of the emptiest of CELLS x CELLS parts of the box."""
    if sight.index is None:
        return None
    lower, upper = sight.box
    cell = np.clip(((sight.positions - lower) / (upper - lower) * CELLS).astype(int), 0, CELLS - 1)
    crowd = np.bincount(cell[:, 0] * CELLS + cell[:, 1], minlength=CELLS * CELLS)
    quiet = int(crowd.argmin())
    aim = (
        lower
        + (upper - lower) * (np.array(divmod(quiet, CELLS)) + 0.5) / CELLS
        - sight.positions[sight.index]
    )
    distance = float(np.hypot(*aim))
    if distance == 0:
        return None
    speed = float(np.hypot(*(upper - lower))) / BOX_CROSSING_SECONDS
    return sight.towards(aim * (speed / distance), seconds=0.4)
