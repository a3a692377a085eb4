"""Players among loose balls."""

from __future__ import annotations

from kuglice.layout import RandomGroup
from kuglice.scene import (
    AttractForce,
    Drag,
    InputLimits,
    PlayerRules,
    Scene,
    SpawnLimits,
    ThrustForce,
)
from kuglice.scenes.bounds import whole

__all__ = ["arena"]

MARGIN = 4.0
"""Free strips at both ends, in which the players appear."""
MOST_PLAYERS = 30
"""Two columns of them as high as the box."""


def arena(players: int = 8, balls: int = 600, seed: int = 1) -> Scene:
    """Up to `players` heavy balls, steered by thrust, among loose ones."""
    whole("arena", most=MOST_PLAYERS, players=players)
    whole("arena", balls=balls)
    whole("arena", least=0, most=None, seed=seed)
    width, height = 64.0, 36.0
    sides = (0.5 * MARGIN, width - 0.5 * MARGIN)
    lanes = (players + 1) // 2
    points = tuple((sides[index % 2], height * (index // 2 + 0.5) / lanes) for index in range(players))
    loose = RandomGroup(
        count=balls,
        radius=(0.25, 0.6),
        speed=2.0,
        seed=seed,
        area=(MARGIN, 0.0, width - MARGIN, height),
    )
    return Scene(
        title="Arena",
        description="Players steer heavy balls through a crowd of loose ones and leave bright wakes behind.",
        box=(0.0, 0.0, width, height),
        forces=(ThrustForce(), AttractForce(softening=2.0), Drag(0.08)),
        groups=(loose,),
        limits=InputLimits(
            thrust=250.0,
            attract=400.0,
            kick=20.0,
            spawn=SpawnLimits(max_radius=1.0, max_mass=4.0, max_speed=20.0),
            remove=True,
            max_balls=balls + players + 200,
        ),
        players=PlayerRules(radius=1.2, mass=8.0, spawn_points=points, max_players=players),
    )
