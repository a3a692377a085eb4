"""How far off predictions were: every ball that is told again is compared with where it was thought to be."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["Accuracy"]

Floats = NDArray[np.float64]

SMALLEST, LARGEST, BINS = 1e-4, 1e4, 400


class Accuracy:
    """Distances in radii, in a histogram of bins that are 4.7 % wide."""

    def __init__(self) -> None:
        self._edges = np.geomspace(SMALLEST, LARGEST, BINS + 1)
        self._counts = np.zeros(BINS + 2, np.int64)
        self._sum = 0.0
        self.worst = 0.0

    def note(self, distances: Floats) -> None:
        """(n,) distances between told and predicted places, in radii."""
        if len(distances):
            self._counts += np.bincount(np.searchsorted(self._edges, distances), minlength=BINS + 2)
            self._sum += float(distances.sum())
            self.worst = max(self.worst, float(distances.max()))

    @property
    def compared(self) -> int:
        """How many distances there were."""
        return int(self._counts.sum())

    @property
    def mean(self) -> float | None:
        """None before anything was compared."""
        return self._sum / self.compared if self.compared else None

    def quantile(self, share: float) -> float | None:
        """The distance that this share of all did not exceed, to 5 %."""
        if not self.compared:
            return None
        at = int(np.searchsorted(np.cumsum(self._counts), share * self.compared))
        return min(float(self._edges[min(at, BINS)]), self.worst)
