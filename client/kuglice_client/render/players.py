"""Players' balls: each in the colour of its player, with a ring, one's own ring in white."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from kuglice import _core
from kuglice_client.render.moment import Moment
from kuglice_client.render.stage import Pixels, Stage

__all__ = ["PLAYER_COLOURS", "mark_players", "player_colours"]

PLAYER_COLOURS: Pixels = np.array(
    [[64, 224, 168], [255, 122, 89], [255, 214, 82], [96, 190, 255], [226, 130, 255], [178, 230, 80]],
    dtype=np.uint8,
)
"""By client number; the seventh client has the first one's colour again."""

OWN = (255, 255, 255, 255)
GAP = 2.0
THICKNESS = 2.5


def player_colours(moment: Moment) -> Iterator[tuple[int, Pixels]]:
    """(row of the ball in the moment's arrays, colour) of every player's ball that is there."""
    for row, client in _rows(moment):
        yield row, PLAYER_COLOURS[(client - 1) % len(PLAYER_COLOURS)]


def mark_players(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """Draw the rings, a little outside of the balls."""
    rows = list(_rows(moment))
    if not rows:
        return
    index = np.array([row for row, _ in rows], dtype=np.intp)
    colours = np.full((len(rows), 4), 255, dtype=np.uint8)
    colours[:, :3] = [colour for _, colour in player_colours(moment)]
    colours[[client == stage.own for _, client in rows]] = OWN
    radius = stage.camera.lengths(moment.radius[index]) + GAP + THICKNESS
    _core.draw_rings(pixels, stage.camera.points(moment.position[index]), radius, THICKNESS, colours)


def _rows(moment: Moment) -> Iterator[tuple[int, int]]:
    for ball, client in moment.players.items():
        row = int(np.searchsorted(moment.id, np.uint64(ball)))
        if row < len(moment.id) and moment.id[row] == ball:
            yield row, client
