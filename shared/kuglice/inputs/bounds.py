"""What a scene lets a client do: every bound of an input, checked before it is scheduled."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from kuglice.errors import InputError
from kuglice.inputs.kinds import OWNER, Attract, Input, Kick, Remove, Spawn, Thrust
from kuglice.wording import of_many

if TYPE_CHECKING:
    from kuglice.scene import Scene
    from kuglice.world import World

__all__ = ["check"]


def check(given: Input, scene: Scene, world: World) -> None:
    """Raise InputError that names input, value and bound unless the scene allows this input now.

    The world's owner (client 0) is held to what is possible, not to what the scene lets clients do.
    Joins and leaves are the server's own doing and pass.
    """
    rule = RULES.get(given.kind)
    if rule is not None:
        rule(given, scene, world)


def _thrust(given: Thrust, scene: Scene, world: World) -> None:
    if _own_ball(given, world) is None:
        raise _refused(given, "the client owns no ball")
    _at_most(given, "force", _length(given.x, given.y), scene.limits.thrust)


def _attract(given: Attract, scene: Scene, world: World) -> None:
    _at_most(given, "strength", abs(given.strength), scene.limits.attract)
    _in_box(given, given.x, given.y, 0.0, scene)


def _kick(given: Kick, scene: Scene, world: World) -> None:
    _at_most(given, "change of speed", _length(given.vx, given.vy), scene.limits.kick)
    ball = _own_ball(given, world) if given.ball is None else given.ball
    if ball is None:
        raise _refused(given, "the client owns no ball and names none")
    if math.isinf(_mass(given, ball, world)):
        raise _refused(given, f"ball {ball} has infinite mass")
    _not_of_others(given, ball, world)


def _remove(given: Remove, scene: Scene, world: World) -> None:
    if given.client != OWNER and not scene.limits.remove:
        raise _refused(given, "the scene allows no remove")
    _mass(given, given.ball, world)
    _not_of_others(given, given.ball, world)


def _spawn(given: Spawn, scene: Scene, world: World) -> None:
    limits = scene.limits.spawn
    _at_most(given, "radius", given.radius, limits.max_radius if limits else None)
    _at_most(given, "mass", given.mass, limits.max_mass if limits else None)
    _at_most(given, "speed", _length(given.vx, given.vy), limits.max_speed if limits else None)
    if given.client != OWNER and world.count >= scene.limits.max_balls:
        raise _refused(
            given, f"{world.count} {of_many(world.count, 'ball')}, at most {scene.limits.max_balls}"
        )
    _in_box(given, given.x, given.y, given.radius, scene)


RULES: dict[str, Callable[[Any, Scene, World], None]] = {
    "thrust": _thrust,
    "attract": _attract,
    "kick": _kick,
    "remove": _remove,
    "spawn": _spawn,
}


def _refused(given: Input, why: str) -> InputError:
    return InputError(f"{given.kind} {given.sequence} of client {given.client}: {why}")


def _at_most(given: Input, what: str, value: float, bound: float | None) -> None:
    if given.client == OWNER:
        return
    if bound is None:
        raise _refused(given, f"the scene allows no {given.kind}")
    if not value <= bound:
        raise _refused(given, f"{what} {value:.6g}, at most {bound:.6g}")


def _length(x: float, y: float) -> float:
    return math.sqrt(x * x + y * y)


def _in_box(given: Input, x: float, y: float, radius: float, scene: Scene) -> None:
    left, bottom, right, top = scene.box
    if not (left + radius <= x <= right - radius and bottom + radius <= y <= top - radius):
        with_radius = f" with radius {radius:.6g}" if radius else ""
        raise _refused(given, f"({x:.6g}, {y:.6g}){with_radius} lies outside the box {list(scene.box)}")


def _own_ball(given: Input, world: World) -> int | None:
    return dict(world.players).get(given.client)


def _mass(given: Input, ball: int, world: World) -> float:
    """Mass of a ball that must exist."""
    with world.view() as balls:
        index = int(np.searchsorted(balls.id, ball))
        if index == len(balls.id) or int(balls.id[index]) != ball:
            raise _refused(given, f"there is no ball {ball}")
        return float(balls.mass[index])


def _not_of_others(given: Input, ball: int, world: World) -> None:
    owner = {owned: client for client, owned in world.players}.get(ball)
    if owner not in (None, given.client) and given.client != OWNER:
        raise _refused(given, f"ball {ball} belongs to client {owner}")
