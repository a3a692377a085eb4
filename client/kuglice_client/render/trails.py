"""Trails: where the balls have just been, fading."""

from __future__ import annotations

import math

import numpy as np

from kuglice import _core
from kuglice.picture import speed_colours
from kuglice_client.render.moment import Moment
from kuglice_client.render.players import player_colours
from kuglice_client.render.stage import Pixels, Stage

__all__ = ["Trails"]

THICKNESS = 0.9
"""In radii of the ball."""
OPACITY = 150
LEFT = 0.05
"""What is left of a trail at the end of its time."""


class Trails:
    """A picture behind the balls to which every frame adds the way since the last one, after fading the rest.

    So the cost does not depend on how long trails are. A jump back in time starts anew.
    """

    def __init__(self, background: Pixels, duration: float) -> None:
        self._background = background
        self._layer = background.copy()
        self._duration = duration
        self._last: Moment | None = None

    def follow(self, stage: Stage, moment: Moment) -> Pixels:
        """Add the way since the last moment; the background with all trails on it."""
        last, self._last = self._last, moment
        if last is None or moment.time < last.time:
            np.copyto(self._layer, self._background)
        elif moment.time > last.time:
            keep = math.exp((moment.time - last.time) / self._duration * math.log(LEFT))
            _core.fade(self._layer, self._background, int(256 * keep))
            self._extend(stage, last, moment)
        return self._layer

    def _extend(self, stage: Stage, last: Moment, moment: Moment) -> None:
        colours = speed_colours(moment.velocity, stage.reference)
        colours[:, 3] = OPACITY
        for row, colour in player_colours(moment):
            colours[row, :3] = colour
        start, end, radius = last.position, moment.position, moment.radius
        if not np.array_equal(last.id, moment.id):
            _, there, here = np.intersect1d(last.id, moment.id, assume_unique=True, return_indices=True)
            start, end, radius, colours = start[there], end[here], radius[here], colours[here]
        moved = (start != end).any(axis=1)
        _core.draw_segments(
            self._layer,
            stage.camera.points(start[moved]),
            stage.camera.points(end[moved]),
            stage.camera.lengths(radius[moved]) * THICKNESS,
            colours[moved],
            lighten=True,
        )
