"""Pairs that meet head-on, at every phase of the tick: how many pass through each other."""

from __future__ import annotations

import numpy as np

from kuglice import _core
from kuglice.lab.methods import Method
from kuglice.scene import Balls, Scene
from kuglice.world import World

__all__ = ["share", "theory"]

PAIRS = 400
APART = 10.0
"""Between lanes, in radii."""


def share(contacts: str, move: float, seed: int = 1) -> float:
    """Of PAIRS pairs of radius 1 whose distance shrinks by `move` in a tick, the share that tunnels."""
    phase = _core.random_uniform(seed, 0, 0, PAIRS)
    lane = APART * np.arange(PAIRS)
    gap = 2.0 + move * (1.0 + phase)
    position = np.concatenate([np.column_stack([-gap / 2, lane]), np.column_stack([gap / 2, lane])])
    velocity = np.zeros_like(position)
    velocity[:PAIRS, 0], velocity[PAIRS:, 0] = move / 2, -move / 2
    half = 4.0 + 2.0 * move
    scene = Scene(
        box=(-half, -APART, half, APART * PAIRS),
        walls=False,
        tick_rate=1.0,
        balls=Balls(position=position, velocity=velocity, radius=1.0),
    )
    world = World(scene, Method("verlet", contacts).model())
    world.run(4)
    return float((world.velocity[:PAIRS, 0] > 0).mean())


def theory(move: float) -> float:
    """For `overlap`: seen if a tick ends within r1 + r2 = 2 of approach, the centres not yet passed."""
    return 1.0 - min(1.0, 2.0 / move)
