"""The occupied nodes of the quadtree."""

from __future__ import annotations

import numpy as np

from kuglice import _core
from kuglice_client.render.moment import Moment
from kuglice_client.render.stage import Pixels, Stage

__all__ = ["draw_tree"]

LINE = (120, 235, 215, 120)
THICKNESS = 1.0


def draw_tree(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """Outlines of the nodes; an edge that several share is brighter."""
    if moment.nodes is None or not len(moment.nodes):
        return
    # On the middle of a pixel a line of one pixel is sharp.
    sides = np.floor(stage.camera.rectangles(moment.nodes)) + 0.5
    colours = np.broadcast_to(np.array(LINE, dtype=np.uint8), (len(moment.nodes), 4))
    _core.draw_rectangles(pixels, sides, THICKNESS, colours)
