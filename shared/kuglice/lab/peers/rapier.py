"""Rapier (rapier2d): impulses with soft constraints, f32, bounding-volume tree. Built only by `make rapier`."""

from __future__ import annotations

from importlib import import_module

import numpy as np
from numpy.typing import NDArray

from kuglice.lab.running import CannotRunError
from kuglice.scene import Scene

__all__ = ["Rapier"]

THICK = 2.0
"""Half the thickness of the walls, in largest radii: a thin one would be jumped over."""


class Rapier:
    """Discs without friction that cannot rotate or sleep; defaults of the library otherwise."""

    def __init__(self, scene: Scene) -> None:
        try:
            native = import_module("kuglice.lab.peers._rapier")
        except ModuleNotFoundError as error:
            raise CannotRunError(
                "it is not built: `make rapier` does that, where there is a Rust toolchain"
            ) from error
        if not {force.kind for force in scene.forces} <= {"gravity"}:
            raise CannotRunError(
                "it has no force but gravity of its own; a callback per ball is no fair race"
            )
        if scene.restitution != 1.0:
            raise CannotRunError("only elastic scenes are compared")
        pulls = [(force.x, force.y) for force in scene.forces if force.kind == "gravity"]
        balls = scene.balls
        self._world = native.World(
            balls.position,
            balls.velocity,
            balls.radius,
            balls.mass,
            _walls(scene),
            (float(sum(x for x, _ in pulls)), float(sum(y for _, y in pulls))),
            1.0 / scene.tick_rate,
        )

    def run(self, ticks: int) -> None:
        """That many steps."""
        self._world.run(ticks)

    @property
    def position(self) -> NDArray[np.float64]:
        """(n, 2)."""
        found: NDArray[np.float64] = self._world.position()
        return found

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n, 2)."""
        found: NDArray[np.float64] = self._world.velocity()
        return found

    @property
    def collisions(self) -> int:
        """Not counted."""
        return 0


def _walls(scene: Scene) -> NDArray[np.float64]:
    """(4, 4): middle and half sides of a block behind each side of the box; none without walls."""
    if not scene.walls:
        return np.empty((0, 4))
    left, bottom, right, top = scene.box
    thick = THICK * float(scene.balls.radius.max())
    across, along = 0.5 * (right - left) + 2.0 * thick, 0.5 * (top - bottom)
    x, y = 0.5 * (left + right), 0.5 * (bottom + top)
    blocks = [
        (left - thick, y, thick, along),
        (right + thick, y, thick, along),
        (x, bottom - thick, across, thick),
        (x, top + thick, across, thick),
    ]
    return np.array(blocks)
