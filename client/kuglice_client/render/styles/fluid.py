"""The balls as one smooth liquid surface, lighter where it is fast."""

from __future__ import annotations

import numpy as np

from kuglice import _core
from kuglice.picture import draw_balls, speed_colours, speed_values
from kuglice.picture.oklab import ramp
from kuglice_client.render.moment import Moment
from kuglice_client.render.players import mark_players, player_colours
from kuglice_client.render.stage import Pixels, Stage

__all__ = ["WATER", "draw_fluid"]

WATER: Pixels = ramp(
    [(0.42, 0.13, 262), (0.56, 0.15, 250), (0.72, 0.12, 225), (0.88, 0.07, 205), (0.98, 0.01, 200)]
)
"""(256, 3) from still and deep to fast and foaming."""

OPACITY = 0.93


def draw_fluid(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """A lone ball is a drop of its own size, balls close to each other melt together.

    Pegs and players' balls stay balls: what holds the liquid up, or steers through it, is no part of it.
    """
    players = list(player_colours(moment))
    solid = np.zeros(len(moment.radius), dtype=np.bool_) if moment.fixed is None else moment.fixed.copy()
    colours = speed_colours(moment.velocity, stage.reference, moment.fixed)
    for row, colour in players:
        solid[row] = True
        colours[row, :3] = colour
    liquid = ~solid
    _core.draw_fluid(
        pixels,
        stage.camera.points(moment.position[liquid]),
        stage.camera.lengths(moment.radius[liquid]),
        speed_values(moment.velocity[liquid], stage.reference),
        WATER,
        OPACITY,
        stage.camera.window() if stage.scene.walls else None,
    )
    if solid.any():
        draw_balls(pixels, stage.camera, moment.position[solid], moment.radius[solid], colours[solid])
    mark_players(pixels, stage, moment)
