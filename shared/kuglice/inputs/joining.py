"""Where a new player's ball appears."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kuglice.errors import InputError
from kuglice.inputs.kinds import Join

if TYPE_CHECKING:
    from kuglice.scene import Scene
    from kuglice.world import World

__all__ = ["join"]


def join(scene: Scene, world: World, client: int, sequence: int = 0) -> Join:
    """The Join of a client: at the spawn point with the most room, or without a ball if the scene gives none.

    Raises InputError at `max_players` or `max_balls`. Only the owner of the world calls it; everybody else
    applies the Join that comes out.
    """
    rules = scene.players
    if rules is None:
        return Join(client=client, sequence=sequence)
    joined = world.players
    if any(player == client for player, _ in joined):
        raise InputError(f"join: client {client} has joined already")
    if len(joined) >= rules.max_players:
        raise InputError(
            f"join: client {client} refused at {len(joined)} players, at most {rules.max_players}"
        )
    if world.count >= scene.limits.max_balls:
        raise InputError(
            f"join: client {client} refused at {world.count} balls, at most {scene.limits.max_balls}"
        )
    x, y = rules.spawn_points[_roomiest(rules.spawn_points, world)]
    return Join(client=client, sequence=sequence, x=x, y=y, radius=rules.radius, mass=rules.mass)


def _roomiest(points: tuple[tuple[float, float], ...], world: World) -> int:
    """Index of the point farthest from the surface of any ball; the first one among equals."""
    if world.count == 0:
        return 0
    with world.view() as balls:
        room = []
        for x, y in points:
            dx, dy = balls.position[:, 0] - x, balls.position[:, 1] - y
            room.append(float((np.sqrt(dx * dx + dy * dy) - balls.radius).min()))
    return room.index(max(room))
