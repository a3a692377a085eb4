"""A world that is quick to serve: a dozen balls, two spawn points, every kind of input within bounds."""

from __future__ import annotations

import numpy as np

from kuglice import (
    AttractForce,
    Balls,
    InputLimits,
    PlayerRules,
    Scene,
    SpawnLimits,
    ThrustForce,
)

__all__ = ["small_arena"]


def small_arena(*, players: int = 2, per_tick: int = 4) -> Scene:
    grid = np.array([(x, y) for x in (4.0, 8.0, 12.0, 16.0) for y in (2.0, 5.0, 8.0)])
    return Scene(
        title="Small arena",
        box=(0.0, 0.0, 20.0, 10.0),
        balls=Balls(position=grid, velocity=np.roll(grid, 1) * 0.3 - 1.0, radius=0.5, mass=1.0),
        forces=(ThrustForce(), AttractForce(softening=1.0)),
        limits=InputLimits(
            thrust=50.0,
            attract=20.0,
            kick=5.0,
            spawn=SpawnLimits(max_radius=0.5, max_mass=2.0, max_speed=5.0),
            remove=True,
            max_balls=40,
            per_tick=per_tick,
        ),
        players=PlayerRules(
            radius=0.4, mass=2.0, spawn_points=((1.0, 1.0), (19.0, 9.0)), max_players=players
        ),
    )
