"""A mean with its standard error, and its limit for an infinitely large box."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Estimate:
    """A value and its standard error."""

    value: float
    error: float

    def sigmas(self, expected: float) -> float:
        """Distance from what theory says, in standard errors."""
        return abs(self.value - expected) / self.error


def of_blocks(blocks: ArrayLike) -> Estimate:
    """From means over blocks of a run, each long enough to have forgotten the one before."""
    values = np.asarray(blocks, dtype=float)
    return Estimate(float(values.mean()), float(values.std(ddof=1) / np.sqrt(len(values))))


def extrapolate(small: tuple[int, Estimate], large: tuple[int, Estimate]) -> Estimate:
    """From two sizes (n, estimate) to n = infinity.

    Walls are a share 1 / sqrt(n) of a box, and shift a mean by as much.
    """
    (n1, one), (n2, two) = small, large
    weight1, weight2 = np.sqrt(n1), np.sqrt(n2)
    value = (weight2 * two.value - weight1 * one.value) / (weight2 - weight1)
    error = np.hypot(weight2 * two.error, weight1 * one.error) / (weight2 - weight1)
    return Estimate(float(value), float(error))
