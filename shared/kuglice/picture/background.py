"""What is behind the balls: a dark room with its walls."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice import _core
from kuglice.picture.camera import Camera

__all__ = ["background"]

Pixels = NDArray[np.uint8]

OUTSIDE = (9, 11, 16)
TOP = (26, 32, 46)
BOTTOM = (14, 18, 27)
WALL = (86, 101, 126, 255)
OPEN = (86, 101, 126, 90)
THICKNESS = 2.0


def background(camera: Camera, *, walls: bool = True) -> Pixels:
    """(height, width, 3) bytes. Without walls the edge of the box is only hinted at."""
    width, height = camera.size
    pixels = np.empty((height, width, 3), dtype=np.uint8)
    pixels[:] = OUTSIDE
    left, top, right, bottom = camera.window()
    down = np.linspace(0.0, 1.0, max(1, bottom - top))[:, None]
    pixels[top:bottom, left:right] = _dithered((1 - down) * TOP + down * BOTTOM, right - left)
    # The line lies outside of the box: a ball at the wall touches it and is not drawn over it.
    sides = camera.rectangles(np.array([camera.box])) + np.array([-1, -1, 1, 1]) * (THICKNESS / 2)
    _core.draw_rectangles(pixels, sides, THICKNESS, np.array([WALL if walls else OPEN], dtype=np.uint8))
    return pixels


def _dithered(rows: NDArray[np.float64], width: int) -> Pixels:
    """(n, 3) colours of rows -> (n, width, 3) bytes, without the bands of a rounded dark gradient."""
    x, y = np.meshgrid(np.arange(width), np.arange(len(rows)))
    # Interleaved gradient noise (J. Jimenez, Next Generation Post Processing in Call of Duty, 2014).
    noise = np.modf(52.9829189 * np.modf(0.06711056 * x + 0.00583715 * y)[0])[0]
    return np.asarray(np.floor(rows[:, None, :] + noise[:, :, None]), dtype=np.uint8)
