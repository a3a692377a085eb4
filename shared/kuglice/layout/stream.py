"""Random numbers for layouts: a counter-based generator, read in order, one stream per purpose."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice import _core

__all__ = ["DIRECTION", "POSITION", "RADIUS", "RandomStream", "directions"]

Floats = NDArray[np.float64]

POSITION, DIRECTION, RADIUS = range(3)
"""Streams: what one of them draws never shifts the numbers of another."""


class RandomStream:
    """Uniform numbers in [0, 1), each drawn once."""

    def __init__(self, seed: int, stream: int) -> None:
        self._seed, self._stream, self._next = seed, stream, 0

    def take(self, count: int) -> Floats:
        """(count,) numbers."""
        numbers = _core.random_uniform(self._seed, self._stream, self._next, count)
        self._next += count
        return numbers

    def pairs(self, count: int) -> Floats:
        """(count, 2) numbers."""
        return self.take(2 * count).reshape(count, 2)


def directions(stream: RandomStream, count: int) -> Floats:
    """(count, 2) unit vectors, even in angle, by rejection: sin and cos differ by platform."""
    made = np.empty((count, 2))
    missing = np.arange(count)
    while missing.size:
        drawn = 2.0 * stream.pairs(missing.size) - 1.0
        squared = drawn[:, 0] * drawn[:, 0] + drawn[:, 1] * drawn[:, 1]
        # Too short a vector would lose digits when it is made long.
        good = (squared <= 1.0) & (squared > 1e-4)
        made[missing[good]] = drawn[good] / np.sqrt(squared[good])[:, None]
        missing = missing[~good]
    return made
