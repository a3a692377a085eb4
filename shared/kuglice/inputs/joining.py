"""Where a new player's ball appears."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kuglice.errors import InputError
from kuglice.inputs.kinds import Join
from kuglice.wording import of_many

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from kuglice.scene import PlayerRules, Scene
    from kuglice.world import World

    Floats = NDArray[np.float64]
    Point = tuple[float, float]

__all__ = ["join"]

PLACES_A_SIDE = 64
"""Places tried along the longer side, at most: the server looks between two ticks."""


def join(scene: Scene, world: World, client: int, sequence: int = 0) -> Join:
    """The Join of a client: at the spawn point with the most room, or without a ball if the scene gives none.

    Where every spawn point is blocked, at the nearest place that has room.

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
            f"join: client {client} refused at {len(joined)} {of_many(len(joined), 'player')},"
            f" at most {rules.max_players}"
        )
    if world.count >= scene.limits.max_balls:
        raise InputError(
            f"join: client {client} refused at {world.count} {of_many(world.count, 'ball')},"
            f" at most {scene.limits.max_balls}"
        )
    x, y = _place(rules, scene, world)
    return Join(client=client, sequence=sequence, x=x, y=y, radius=rules.radius, mass=rules.mass)


def _place(rules: PlayerRules, scene: Scene, world: World) -> Point:
    """The spawn point with the most room; where none has enough, the nearest place to one that has.

    In a box without any, the roomiest spawn point it is: a player who waits for ever would be worse off.
    """
    points = rules.spawn_points
    if world.count == 0:
        return points[0]
    with world.view() as balls:
        room = [_room(point, balls.position, balls.radius) for point in points]
        best = points[room.index(max(room))]
        if max(room) >= rules.radius:
            return best
        for place in _places(rules, scene):
            if _room(place, balls.position, balls.radius) >= rules.radius:
                return place
    return best


def _room(point: Point, position: Floats, radius: Floats) -> float:
    """From a point to the nearest surface of a ball; below 0 inside of one."""
    dx, dy = position[:, 0] - point[0], position[:, 1] - point[1]
    return float((np.sqrt(dx * dx + dy * dy) - radius).min())


def _places(rules: PlayerRules, scene: Scene) -> list[Point]:
    """A grid over all of the box where the ball fits in, by distance to the nearest spawn point."""
    left, bottom, right, top = scene.box
    width, height = right - left - 2 * rules.radius, top - bottom - 2 * rules.radius
    if width < 0 or height < 0:
        return []
    pitch = max(rules.radius / 2, max(width, height) / PLACES_A_SIDE)
    across, up = int(width / pitch), int(height / pitch)
    places = [
        (left + rules.radius + i * pitch, bottom + rules.radius + j * pitch)
        for i in range(across + 1)
        for j in range(up + 1)
    ]

    def away(place: Point) -> float:
        steps = ((place[0] - x, place[1] - y) for x, y in rules.spawn_points)
        return min(dx * dx + dy * dy for dx, dy in steps)

    return sorted(places, key=away)
