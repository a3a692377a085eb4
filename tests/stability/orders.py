"""Order of convergence from measured errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def order(ticks: Sequence[int], errors: Sequence[float]) -> float:
    """Slope of log error over log dt, by least squares; dt = duration / ticks."""
    return float(-np.polyfit(np.log(ticks), np.log(errors), 1)[0])
