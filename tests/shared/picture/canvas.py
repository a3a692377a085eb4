"""Pictures to draw on, and discs measured in another way."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]


def black(width: int, height: int) -> Pixels:
    return np.zeros((height, width, 3), dtype=np.uint8)


def floats(*rows: object) -> NDArray[np.float64]:
    return np.array(rows, dtype=np.float64)


def colours(*rows: tuple[int, int, int, int]) -> Pixels:
    return np.array(rows, dtype=np.uint8)


def white(count: int = 1) -> Pixels:
    return np.full((count, 4), 255, dtype=np.uint8)


def disc_coverage(width: int, height: int, x: float, y: float, radius: float) -> NDArray[np.float64]:
    """(height, width) covered part of each pixel: exact chords on many lines through every row."""
    lines = 64
    at = (np.arange(height * lines) + 0.5) / lines - y
    half = np.sqrt(np.maximum(radius**2 - at**2, 0.0))[:, None]
    left = np.arange(width)[None, :] - x
    part = np.minimum(half, left + 1) - np.maximum(-half, left)
    return np.asarray(np.clip(part, 0.0, None).reshape(height, lines, width).mean(axis=1))
