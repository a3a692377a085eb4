"""Positions between two states, for whoever draws at a rate that is not the world's."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["blend"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


def blend(before_id: Ids, before: Floats, now_id: Ids, now: Floats, alpha: float) -> Floats:
    """alpha now + (1 - alpha) before, (n, 2) in the order of `now_id`, alpha within 0 and 1.

    A ball that is new is where it is now, one that is gone is left out. Ids ascend.
    """
    if np.array_equal(before_id, now_id):
        return alpha * now + (1 - alpha) * before
    _, here, there = np.intersect1d(now_id, before_id, assume_unique=True, return_indices=True)
    drawn = now.copy()
    drawn[here] = alpha * now[here] + (1 - alpha) * before[there]
    return drawn
