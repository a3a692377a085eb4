"""How far balls may move in a tick, compared with what they could pass through."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from kuglice.scene import Scene

__all__ = ["Travel", "longest_travel"]


class Travel(NamedTuple):
    """The worst case of a scene."""

    who: str
    speed: float
    """Units per second."""
    share: float
    """Of the mean of its own radius and the smallest, moved in a tick; above 2 it can miss a ball."""


def longest_travel(scene: Scene) -> Travel:
    """Over all balls at the start, falling through the whole box, and over what clients may add to that."""
    cases = [_start(scene), *_clients(scene)]
    return max(cases, key=lambda case: case.share)


def _start(scene: Scene) -> Travel:
    balls = scene.balls
    movable = ~np.isinf(balls.mass)
    if not movable.any():
        return Travel("no ball", 0.0, 0.0)
    velocity = balls.velocity[movable]
    squared = velocity[:, 0] * velocity[:, 0] + velocity[:, 1] * velocity[:, 1] + _fall(scene)
    speed = np.sqrt(squared)
    shares = speed / (scene.tick_rate * 0.5 * (balls.radius[movable] + balls.radius.min()))
    worst = int(shares.argmax())
    return Travel("a ball", float(speed[worst]), float(shares[worst]))


def _clients(scene: Scene) -> list[Travel]:
    limits, players = scene.limits, scene.players
    smallest = float(scene.balls.radius.min()) if len(scene.balls) else math.inf
    kick = limits.kick or 0.0
    cases = []
    if limits.spawn is not None:
        # How small a spawned ball will be is not known: it counts as the smallest that is there.
        radius = min(limits.spawn.max_radius, smallest)
        speed = math.sqrt(limits.spawn.max_speed**2 + _fall(scene))
        cases.append(Travel("a spawned ball", speed, speed / (scene.tick_rate * radius)))
    if players is not None:
        speed = math.sqrt(_thrust(scene) ** 2 + _fall(scene)) + kick
        reach = 0.5 * (players.radius + min(players.radius, smallest))
        cases.append(Travel("a player's ball", speed, speed / (scene.tick_rate * reach)))
    elif kick and math.isfinite(smallest):
        cases.append(Travel("a ball that is kicked", kick, kick / (scene.tick_rate * smallest)))
    return cases


def _fall(scene: Scene) -> float:
    """Square of the speed that gravity gives to a ball on its way through the box."""
    left, bottom, right, top = scene.box
    return sum(
        2.0 * (abs(force.x) * (right - left) + abs(force.y) * (top - bottom))
        for force in scene.forces
        if force.kind == "gravity"
    )


def _thrust(scene: Scene) -> float:
    """Speed of a player that thrusts all the way through the box, or against drag for ever."""
    if scene.limits.thrust is None or scene.players is None:
        return 0.0
    left, bottom, right, top = scene.box
    longest = math.sqrt((right - left) ** 2 + (top - bottom) ** 2)
    speed = math.sqrt(2.0 * scene.limits.thrust / scene.players.mass * longest)
    drag = sum(force.coefficient for force in scene.forces if force.kind == "drag")
    return min(speed, scene.limits.thrust / drag) if drag else speed
