"""numpy and scipy's cKDTree: what one writes without a compiler. All pairs of a tick exchange at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra
from kuglice.lab.running import CannotRunError
from kuglice.scene import Scene

with extra("peers"):
    from scipy.spatial import cKDTree

__all__ = ["KDTree"]


class KDTree:
    """Move, find overlapping pairs, exchange normal velocities, flip at walls."""

    def __init__(self, scene: Scene) -> None:
        if scene.forces and {force.kind for force in scene.forces} != {"gravity"}:
            raise CannotRunError("only gravity is written for it")
        balls = scene.balls
        self._dt = 1.0 / scene.tick_rate
        self._gravity = np.sum(
            [(force.x, force.y) for force in scene.forces if force.kind == "gravity"] or [(0, 0)], 0
        )
        self._position, self._velocity = balls.position.copy(), balls.velocity.copy()
        self._radius, self._mass = balls.radius, balls.mass
        self._low = np.array(scene.box[:2]) + balls.radius[:, None]
        self._high = np.array(scene.box[2:]) - balls.radius[:, None]
        self._count = 0

    def run(self, ticks: int) -> None:
        """That many steps."""
        for _ in range(ticks):
            self._velocity += self._gravity * self._dt
            self._position += self._velocity * self._dt
            self._collide()
            outwards = ((self._position < self._low) & (self._velocity < 0)) | (
                (self._position > self._high) & (self._velocity > 0)
            )
            self._velocity[outwards] *= -1.0

    def _collide(self) -> None:
        tree = cKDTree(self._position, balanced_tree=False, compact_nodes=False)
        pairs = tree.query_pairs(2.0 * float(self._radius.max()), output_type="ndarray")
        one, two = pairs[:, 0], pairs[:, 1]
        apart = self._position[two] - self._position[one]
        distance = np.sqrt((apart * apart).sum(1))
        relative = self._velocity[two] - self._velocity[one]
        approach = (apart * relative).sum(1)
        hit = (distance < self._radius[one] + self._radius[two]) & (approach < 0) & (distance > 0)
        one, two = one[hit], two[hit]
        normal = apart[hit] / distance[hit, None]
        speed = approach[hit] / distance[hit]
        total = self._mass[one] + self._mass[two]
        np.add.at(self._velocity, one, (2.0 * self._mass[two] / total * speed)[:, None] * normal)
        np.add.at(self._velocity, two, -(2.0 * self._mass[one] / total * speed)[:, None] * normal)
        self._count += len(one)

    @property
    def position(self) -> NDArray[np.float64]:
        """(n, 2)."""
        return self._position.copy()

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n, 2)."""
        return self._velocity.copy()

    @property
    def collisions(self) -> int:
        """Pairs that exchanged velocities."""
        return self._count
