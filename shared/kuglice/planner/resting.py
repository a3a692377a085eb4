"""Whether balls of a scene may come to rest, and against what: few treatments of contacts carry a ball that lies.

Judged by where forces drive, not by where balls are: any of them may lie there later, be it the only one.
"""

from __future__ import annotations

import numpy as np

from kuglice.scene import Scene
from kuglice.scene.forces import Force

__all__ = ["carried", "loses_energy", "settles"]


def carried(scene: Scene) -> bool:
    """Whether a force that lasts drives balls against what cannot give way: walls or pegs."""
    pegs = bool(np.isinf(scene.balls.mass).any())
    if not _movable(scene) or not (scene.walls or pegs):
        return False
    return any(pegs or not _draws_within(scene, force) for force in scene.forces if _pulls(scene, force))


def settles(scene: Scene) -> bool:
    """Whether balls come to rest on walls, on pegs or on each other."""
    return loses_energy(scene) and (carried(scene) or _gathered(scene))


def loses_energy(scene: Scene) -> bool:
    """Whether bouncing dies away: at impacts or on the way."""
    return scene.restitution < 1.0 or any(
        force.kind == "drag" and force.coefficient > 0 for force in scene.forces
    )


def _gathered(scene: Scene) -> bool:
    """Gravity alone, the same for all, leaves balls as far from each other as they are."""
    return _movable(scene) > 1 and any(
        force.kind != "gravity" and _pulls(scene, force) for force in scene.forces
    )


def _movable(scene: Scene) -> float:
    open_ = scene.limits.spawn is not None or scene.players is not None
    return float("inf") if open_ else int(np.isfinite(scene.balls.mass).sum())


def _pulls(scene: Scene, force: Force) -> bool:
    match force.kind:
        case "gravity":
            return bool(force.x or force.y)
        case "spring":
            return force.stiffness > 0
        case "attractor":
            return force.strength != 0
        case "thrust":
            return bool(scene.limits.thrust)
        case "attract":
            return bool(scene.limits.attract)
        case _:
            return False


def _draws_within(scene: Scene, force: Force) -> bool:
    """Whether it draws every ball to a place that the ball reaches before it meets a wall."""
    if force.kind not in ("spring", "attractor") or (force.kind == "attractor" and force.strength < 0):
        return False
    reach = float(scene.balls.radius.max()) if len(scene.balls) else 0.0
    left, bottom, right, top = scene.box
    return left + reach <= force.x <= right - reach and bottom + reach <= force.y <= top - reach
