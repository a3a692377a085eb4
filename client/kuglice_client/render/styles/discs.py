"""Every ball a disc, coloured by its speed."""

from __future__ import annotations

from kuglice.picture import draw_balls, speed_colours
from kuglice_client.render.moment import Moment
from kuglice_client.render.players import mark_players, player_colours
from kuglice_client.render.stage import Pixels, Stage

__all__ = ["draw_discs"]


def draw_discs(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """Balls in id order; players' balls have their player's colour and a ring."""
    colours = speed_colours(moment.velocity, stage.reference, moment.fixed)
    for row, colour in player_colours(moment):
        colours[row, :3] = colour
    draw_balls(pixels, stage.camera, moment.position, moment.radius, colours)
    mark_players(pixels, stage, moment)
