"""What a view is told of one region."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Floats", "Ids", "Node", "Told"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]
Node = NDArray[np.uint32]


@dataclass(frozen=True)
class Told:
    """All balls of `node` in state(`tick`)."""

    tick: int
    node: int
    id: Ids
    position: Floats
    velocity: Floats
    radius: Floats
    mass: Floats
