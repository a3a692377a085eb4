"""From the plane of a scene to the pixels of a picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from kuglice.errors import PictureError

__all__ = ["Camera"]

Floats = NDArray[np.float64]

LARGEST = 16_384
"""Pixels on a side: no codec and no memory is asked for more."""


@dataclass(frozen=True, slots=True)
class Camera:
    """Sees `box` (left, bottom, right, top) in the middle of a picture of `size` (width, height) pixels.

    The y axis of the scene goes up, that of the picture down; both have the same `scale`, pixels per unit.
    """

    box: tuple[float, float, float, float]
    size: tuple[int, int]
    scale: float

    @classmethod
    def fit(cls, box: tuple[float, float, float, float], size: tuple[int, int], margin: float = 12.0) -> Self:
        """The largest view of the whole box that leaves `margin` pixels on each side. Raises PictureError."""
        width, height = size
        if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
            raise PictureError(f"size {width}x{height}: each side must be within 1 and {LARGEST} pixels")
        left, bottom, right, top = box
        if not (np.isfinite(box).all() and left < right and bottom < top):
            raise PictureError(f"box {box}: left < right and bottom < top, all finite, are needed to draw it")
        space = (max(1.0, width - 2 * margin), max(1.0, height - 2 * margin))
        return cls(box, size, min(space[0] / (right - left), space[1] / (top - bottom)))

    @staticmethod
    def size_for(box: tuple[float, float, float, float], longest: int = 1000) -> tuple[int, int]:
        """A size with the proportions of the box, both sides even, the longer one `longest` pixels."""
        left, bottom, right, top = box
        wide, tall = right - left, top - bottom
        unit = longest / max(wide, tall)
        return (max(2, 2 * round(wide * unit / 2)), max(2, 2 * round(tall * unit / 2)))

    @property
    def middle(self) -> tuple[float, float]:
        """The point of the scene that is in the middle of the picture."""
        left, bottom, right, top = self.box
        return (left + right) / 2, (bottom + top) / 2

    def points(self, position: Floats) -> Floats:
        """(n, 2) in the scene -> (n, 2) in pixels."""
        (x, y), (width, height) = self.middle, self.size
        scale = np.array([self.scale, -self.scale])
        origin = np.array([width / 2 - x * self.scale, height / 2 + y * self.scale])
        pixels: Floats = np.asarray(position, dtype=np.float64) * scale + origin
        return pixels

    def lengths(self, length: Floats) -> Floats:
        """Lengths in the scene -> in pixels."""
        return np.multiply(length, self.scale)

    def rectangles(self, sides: Floats) -> Floats:
        """(k, 4) left, bottom, right, top in the scene -> (k, 4) left, top, right, bottom in pixels."""
        corners = self.points(np.asarray(sides, dtype=np.float64).reshape(-1, 2)).reshape(-1, 4)
        return np.ascontiguousarray(corners[:, [0, 3, 2, 1]])

    def window(self) -> tuple[int, int, int, int]:
        """The pixels of the box: first column, first row, last column + 1, last row + 1, rounded outwards."""
        left, top, right, bottom = self.rectangles(np.array([self.box]))[0]
        width, height = self.size
        return (
            max(0, int(np.floor(left))),
            max(0, int(np.floor(top))),
            min(width, int(np.ceil(right))),
            min(height, int(np.ceil(bottom))),
        )
