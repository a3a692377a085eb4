"""Exponents and crossings of measured costs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

__all__ = ["crossing", "exponent"]


def exponent(x: Sequence[float], y: Sequence[float]) -> float:
    """k of y ~ x^k, by least squares of the logarithms. NaN for fewer than two points."""
    if len(x) < 2:
        return float("nan")
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def crossing(x: Sequence[float], first: Sequence[float], second: Sequence[float]) -> float | None:
    """Where `first` begins to be larger than `second`, interpolated in logarithms; None if it never does."""
    difference = np.log(first) - np.log(second)
    for index in range(1, len(x)):
        before, after = float(difference[index - 1]), float(difference[index])
        if before <= 0.0 < after:
            share = -before / (after - before)
            return float(np.exp(np.log(x[index - 1]) + share * np.log(x[index] / x[index - 1])))
    return None
