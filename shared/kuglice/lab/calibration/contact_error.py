"""How wrong positions are after one collision per ball, by what a ball moves in a tick and by packing."""

from __future__ import annotations

import numpy as np

from kuglice.lab.methods import Method
from kuglice.lab.reference import reference, seconds_until
from kuglice.lab.work_precision.errors import position_error
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["contact_error"]

COUNT = 200
GRAINS = 64
"""Of a window, in which one collision per ball is looked for."""


def contact_error(contacts: str, packing: float, move: float, seeds: tuple[int, ...]) -> float:
    """In radii, root mean square over balls and seeds; `move` is speed * tick / radius.

    NaN if a tick is longer than the time to one collision per ball.
    """
    squares = []
    for seed in seeds:
        scene = gas(n=COUNT, packing=packing, radius=1.0, speed=1.0, seed=seed)
        # Long enough for one collision per ball at the lowest packing.
        window, _ = seconds_until(scene, 1.0, 64.0, 64.0 / GRAINS / 16.0)
        ticks = round(window / move)
        if not ticks:
            return float("nan")
        scene = scene.model_copy(update={"tick_rate": ticks / window})
        right = reference(scene)
        world = World(scene, Method("verlet", contacts).model())
        right.run(ticks)
        world.run(ticks)
        squares.append(position_error(world.position, right.position, scene.balls.radius) ** 2)
    return float(np.sqrt(np.mean(squares)))
