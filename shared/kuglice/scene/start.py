"""What must hold of the state a scene starts from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kuglice import _core
from kuglice.balls import Balls
from kuglice.schema.problems import Problem, refuse

if TYPE_CHECKING:
    from kuglice.scene.scene import Scene

__all__ = ["check_start"]

SHOWN = 5


def check_start(scene: Scene) -> None:
    """Raise every problem with box, balls, forces and limits taken together."""
    refuse("Scene", [*_box(scene), *_held_forces(scene)])
    problems = _outside(scene)
    problems += _spawn_points(scene)
    if not scene.allow_overlap and not problems:
        problems += _overlaps(scene)
    refuse("Scene", problems)


def _box(scene: Scene) -> list[Problem]:
    left, bottom, right, top = scene.box
    if left < right and bottom < top:
        return []
    return [Problem(("box",), scene.box, "must be [left, bottom, right, top], left < right and bottom < top")]


def _held_forces(scene: Scene) -> list[Problem]:
    """A limit for an input that no force turns into motion is a slip that would fail silently."""
    kinds = {force.kind for force in scene.forces}
    return [
        Problem(("limits", kind), limit, f'needs a force of kind "{kind}" in forces')
        for kind, limit in (("thrust", scene.limits.thrust), ("attract", scene.limits.attract))
        if limit is not None and kind not in kinds
    ]


def _outside(scene: Scene) -> list[Problem]:
    """Walls hold balls in; a peg never reaches them, so only its centre must lie inside."""
    if not scene.walls:
        return []
    left, bottom, right, top = scene.box
    balls = scene.balls
    still = np.isinf(balls.mass) & (balls.velocity == 0).all(axis=1)
    reach = np.where(still, 0.0, balls.radius)
    x, y = balls.position[:, 0], balls.position[:, 1]
    inside = (x - reach >= left) & (x + reach <= right) & (y - reach >= bottom) & (y + reach <= top)
    wrong = np.flatnonzero(~inside)
    problems = [
        Problem(
            ("balls", "position", int(index)),
            [float(part) for part in balls.position[index]],
            f"with radius {float(balls.radius[index])} lies outside the box {list(scene.box)}",
        )
        for index in wrong[:SHOWN]
    ]
    return problems + _rest("balls that lie outside the box", wrong.size - SHOWN)


def _spawn_points(scene: Scene) -> list[Problem]:
    if scene.players is None:
        return []
    left, bottom, right, top = scene.box
    radius = scene.players.radius
    return [
        Problem(
            ("players", "spawn_points", index),
            [x, y],
            f"a ball of radius {radius} there lies outside the box {list(scene.box)}",
        )
        for index, (x, y) in enumerate(scene.players.spawn_points)
        if not (left + radius <= x <= right - radius and bottom + radius <= y <= top - radius)
    ]


def _overlaps(scene: Scene) -> list[Problem]:
    """Pairs come from the core, so that "overlap" means the very comparison that the step makes."""
    balls = scene.balls
    if len(balls) < 2:
        return []
    crowded = _coincident(balls)
    if crowded:
        return crowded
    model = _core.Model(integrator="euler", contacts="overlap", broadphase="loose_quadtree")
    world = _core.World(
        scene.rules(),
        model,
        position=balls.position,
        velocity=balls.velocity,
        radius=balls.radius,
        mass=balls.mass,
    )
    # Ids count from the first ball in order, so they are indices here.
    pairs = world.overlapping().astype(np.int64) - int(world.id[0])
    # Pegs are often joined to make a wall.
    pairs = pairs[~np.isinf(balls.mass[pairs]).all(axis=1)]
    problems = [_overlap(balls, int(first), int(second)) for first, second in pairs[:SHOWN]]
    return problems + _rest("pairs that overlap", len(pairs) - SHOWN)


def _coincident(balls: Balls) -> list[Problem]:
    """Equal centres first: n balls in one place are n^2 pairs, which no list should have to hold."""
    movable = np.flatnonzero(~np.isinf(balls.mass))
    order: NDArray[np.intp] = movable[np.lexsort(balls.position[movable].T)]
    place = balls.position[order]
    same = np.flatnonzero((place[1:] == place[:-1]).all(axis=1))
    problems = [_overlap(balls, int(order[at]), int(order[at + 1])) for at in same[:SHOWN]]
    return problems + _rest("balls with equal centres", same.size - SHOWN)


def _overlap(balls: Balls, first: int, second: int) -> Problem:
    difference = balls.position[second] - balls.position[first]
    distance = float(np.sqrt(difference[0] * difference[0] + difference[1] * difference[1]))
    least = float(balls.radius[first] + balls.radius[second])
    return Problem(
        ("balls", "position", second),
        [float(part) for part in balls.position[second]],
        f"overlaps ball {first}: distance {distance:.6g} is less than the sum of radii {least:.6g}"
        " (allow_overlap = true permits it)",
    )


def _rest(what: str, count: int) -> list[Problem]:
    return [Problem(("balls", "position"), f"{count} more", what)] if count > 0 else []
