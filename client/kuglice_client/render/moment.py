"""What is to be seen at one moment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

__all__ = ["HashState", "Moment", "Verdict", "between"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]

Verdict = Literal["local", "waiting", "equal", "different"]
"""Nobody to compare with; not compared yet; equal to the server's; different from it."""


@dataclass(frozen=True, slots=True)
class HashState:
    """A state hash, the tick that it is of, and what became of comparing it."""

    hash: int
    tick: int
    verdict: Verdict = "local"


@dataclass(frozen=True, slots=True)
class Moment:
    """Balls in id order: position and velocity (n, 2), radius (n,), id (n,); units of the scene."""

    position: Floats
    velocity: Floats
    radius: Floats
    id: Ids
    tick: int = 0
    time: float = 0.0
    """Seconds since the start of the scene; between two ticks, between their times."""
    fixed: NDArray[np.bool_] | None = None
    """(n,) which balls are pegs."""
    players: Mapping[int, int] = field(default_factory=dict)
    """Ball id -> client whose ball it is."""
    hash_state: HashState | None = None
    nodes: Floats | None = None
    """(k, 4) left, bottom, right, top of quadtree nodes."""


def between(previous: Moment, current: Moment, alpha: float) -> Moment:
    """The moment alpha * current + (1 - alpha) * previous, alpha within 0 and 1.

    A ball that is new is drawn where it is now, one that is gone is not drawn. The rest is the current
    moment's.
    """
    time = alpha * current.time + (1 - alpha) * previous.time
    if np.array_equal(previous.id, current.id):
        position = alpha * current.position + (1 - alpha) * previous.position
        return replace(current, position=position, time=time)
    shared, here, there = np.intersect1d(current.id, previous.id, assume_unique=True, return_indices=True)
    position = current.position.copy()
    if len(shared):
        position[here] = alpha * current.position[here] + (1 - alpha) * previous.position[there]
    return replace(current, position=position, time=time)
