"""The walls of a world of which the picture shows a part."""

from __future__ import annotations

import numpy as np

from kuglice import _core
from kuglice_client.render.moment import Moment
from kuglice_client.render.stage import Pixels, Stage

__all__ = ["draw_walls"]

WALL = (150, 166, 196, 255)
OPEN = (150, 166, 196, 90)
THICKNESS = 3.0
FAR = 1e6
"""Pixels: a wall as far away is as good as one at infinity."""


def draw_walls(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """The edge of the world's box where it is in sight; fainter where there is no wall."""
    if moment.window is None:
        return
    left, bottom, right, _ = moment.window.rectangle
    shown_left, shown_bottom, shown_right, _ = stage.scene.box
    scale = (shown_right - shown_left) / (right - left)
    box = (np.array([moment.window.box]) - (left, bottom, left, bottom)) * scale
    box += (shown_left, shown_bottom, shown_left, shown_bottom)
    # Outside of the box, as in a picture of all of it: a ball at the wall touches the line.
    outwards = np.array([-1, -1, 1, 1]) * (THICKNESS / 2)
    sides = np.clip(stage.camera.rectangles(box) + outwards, -FAR, FAR)
    colour = np.array([WALL if moment.window.walls else OPEN], dtype=np.uint8)
    _core.draw_rectangles(pixels, sides, THICKNESS, colour)
