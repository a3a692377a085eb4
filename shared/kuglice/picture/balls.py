"""Balls onto a picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice import _core
from kuglice.picture.background import background
from kuglice.picture.camera import Camera
from kuglice.picture.speed import speed_colours

__all__ = ["draw", "draw_balls"]

Floats = NDArray[np.float64]
Pixels = NDArray[np.uint8]


def draw_balls(pixels: Pixels, camera: Camera, position: Floats, radius: Floats, colours: Pixels) -> None:
    """Draw balls onto a picture, in place, in order.

    `position` (n, 2) and `radius` (n,) in units of the scene, `colours` (n, 4) red, green, blue, opacity. The
    middle of a ball has its colour; the rest is shaded as if lit from the top left.
    """
    _core.draw_discs(pixels, camera.points(position), camera.lengths(radius), colours, shaded=True)


def draw(
    position: Floats,
    velocity: Floats,
    radius: Floats,
    *,
    box: tuple[float, float, float, float],
    size: tuple[int, int] | None = None,
    reference: float | None = None,
    fixed: NDArray[np.bool_] | None = None,
    walls: bool = True,
) -> Pixels:
    """A picture (height, width, 3) of balls coloured by speed.

    `reference` is the speed that gets the last colour, by default the highest there is. Raises PictureError
    for a size or a box that cannot be drawn.
    """
    camera = Camera.fit(box, Camera.size_for(box) if size is None else size)
    if reference is None:
        reference = float(np.hypot(velocity[:, 0], velocity[:, 1]).max(initial=0.0)) or 1.0
    pixels = background(camera, walls=walls)
    draw_balls(pixels, camera, position, radius, speed_colours(velocity, reference, fixed))
    return pixels
