"""What a ball-step of `event` costs once balls that lose energy lie on a floor, and on each other."""

from __future__ import annotations

import time

from kuglice.layout import RandomGroup
from kuglice.model import Model
from kuglice.scene import Gravity, Scene
from kuglice.world import World

__all__ = ["LAYERS", "pile_cost"]

LAYERS = (0.5, 2.0)
COUNT = 100
RADIUS = 0.25
SECONDS = 5.0
"""After which balls of restitution 0.5 lie."""
TICKS = 10


def pile_cost(contacts: str, layers: float) -> float:
    """ns per ball-step at 60 ticks per second; of 10 ticks, whose scatter is small beside what layers change."""
    scene = Scene(
        box=(0.0, 0.0, COUNT * 2.0 * RADIUS / layers, 8.0 * RADIUS * layers + 4.0),
        restitution=0.5,
        forces=(Gravity(0.0, -10.0),),
        groups=(RandomGroup(count=COUNT, radius=RADIUS, speed=1.0),),
    )
    world = World(scene, Model(contacts=contacts))
    world.run(round(SECONDS * scene.tick_rate))
    started = time.perf_counter()
    world.run(TICKS)
    return (time.perf_counter() - started) * 1e9 / (TICKS * COUNT)
