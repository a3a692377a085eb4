"""What a view shows, for a film whose picture is the rectangle, wherever it moves."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from kuglice import Scene
from kuglice_client.render.moment import Moment, Window

if TYPE_CHECKING:
    from kuglice.protocol import Rectangle
    from kuglice_client.view.view import View

__all__ = ["framed", "moment", "stage"]


def moment(view: View, alpha: float) -> Moment:
    """The balls that reach into the rectangle, where they are `alpha` of the way to the last tick."""
    world = view.replica.known.world
    position = view.correction.drawn(world.id, world.position)
    position = position - world.velocity * ((1 - alpha) / world.scene.tick_rate)
    radius = world.radius
    left, bottom, right, top = view.rectangle
    x, y = position[:, 0], position[:, 1]
    near = (x + radius > left) & (x - radius < right) & (y + radius > bottom) & (y - radius < top)
    return Moment(
        position=position[near],
        velocity=world.velocity[near],
        radius=radius[near],
        id=world.id[near],
        tick=world.tick,
        time=world.time - (1 - alpha) / world.scene.tick_rate,
        fixed=np.isinf(world.mass[near]),
        players={ball: client for client, ball in world.players if ball is not None},
        silent=view.replica.silent(time.monotonic()),
        window=Window(view.rectangle, world.scene.box, world.scene.walls),
    )


def stage(view: View) -> Scene:
    """An empty scene as large as the rectangle: what a film of the view is a film of."""
    left, bottom, right, top = view.rectangle
    return Scene(
        title=view.replica.scene.title,
        box=(0.0, 0.0, right - left, top - bottom),
        walls=False,
        tick_rate=view.replica.scene.tick_rate,
    )


def framed(seen: Moment, rectangle: Rectangle, scene: Scene) -> Moment:
    """The moment with the rectangle moved to where the stage is, and made as wide."""
    left, bottom, right, _ = rectangle
    scale = scene.box[2] / (right - left)
    position = (seen.position - (left, bottom)) * scale
    return replace(seen, position=position, radius=seen.radius * scale)
