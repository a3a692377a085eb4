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
    shades = np.rint((1 - down) * TOP + down * BOTTOM)
    pixels[top:bottom, left:right] = shades.astype(np.uint8)[:, None, :]
    # The line lies outside of the box: a ball at the wall touches it and is not drawn over it.
    sides = camera.rectangles(np.array([camera.box])) + np.array([-1, -1, 1, 1]) * (THICKNESS / 2)
    _core.draw_rectangles(pixels, sides, THICKNESS, np.array([WALL if walls else OPEN], dtype=np.uint8))
    return pixels
