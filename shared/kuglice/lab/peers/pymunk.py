"""pymunk (Chipmunk2D): impulses iterated over all contacts of a step, f64, bounding-box tree."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra
from kuglice.lab.running import CannotRunError
from kuglice.scene import Scene

with extra("lab"):
    import pymunk
    import pymunk.batch

__all__ = ["Pymunk"]

THICK = 1.0
"""Radius of the walls, in largest radii: a thin one would be jumped over."""


class Pymunk:
    """Discs without friction that cannot rotate; defaults of the library but for `iterations`."""

    def __init__(self, scene: Scene, *, iterations: int = 10) -> None:
        self._dt = 1.0 / scene.tick_rate
        self._count = 0
        space = pymunk.Space()
        space.iterations = iterations
        self._forces(space, scene)
        balls = scene.balls
        for position, velocity, radius, mass in zip(
            balls.position.tolist(),
            balls.velocity.tolist(),
            balls.radius.tolist(),
            balls.mass.tolist(),
            strict=True,
        ):
            fixed = math.isinf(mass)
            body = pymunk.Body(body_type=pymunk.Body.STATIC) if fixed else pymunk.Body(mass, math.inf)
            body.position, body.velocity = tuple(position), tuple(velocity)
            disc = pymunk.Circle(body, radius)
            disc.elasticity = 1.0
            disc.friction = 0.0
            disc.collision_type = 1
            space.add(body, disc)
        if scene.walls:
            self._walls(space, scene)
        self._space = space

    @staticmethod
    def _forces(space: pymunk.Space, scene: Scene) -> None:
        masses = set(scene.balls.mass.tolist())
        for force in scene.forces:
            if force.kind == "gravity":
                space.gravity = (force.x, force.y)
            elif force.kind == "drag" and len(masses) == 1:
                # A space damps all velocities by one factor: linear drag if masses are equal.
                space.damping = math.exp(-force.coefficient / masses.pop())
            else:
                raise CannotRunError(
                    f"it has no force {force.kind!r} of its own; a callback per ball is no fair race"
                )
        if scene.restitution != 1.0:
            raise CannotRunError("its elasticity is a product over shapes; only elastic scenes are compared")

    @staticmethod
    def _walls(space: pymunk.Space, scene: Scene) -> None:
        thick = THICK * float(scene.balls.radius.max())
        left, bottom, right, top = scene.box
        left, bottom, right, top = left - thick, bottom - thick, right + thick, top + thick
        corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            wall = pymunk.Segment(space.static_body, start, end, thick)
            wall.elasticity = 1.0
            wall.friction = 0.0
            space.add(wall)

    def count_collisions(self) -> None:
        """From now on, at the price of a callback per contact that begins."""

        def begin(arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
            self._count += 1

        self._space.on_collision(1, 1, begin=begin)

    def run(self, ticks: int) -> None:
        """That many steps."""
        step, dt = self._space.step, self._dt
        for _ in range(ticks):
            step(dt)

    @property
    def position(self) -> NDArray[np.float64]:
        """(n, 2)."""
        return np.array([tuple(body.position) for body in self._space.bodies])

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n, 2)."""
        return np.array([tuple(body.velocity) for body in self._space.bodies])

    @property
    def collisions(self) -> int:
        """Contacts that began since `count_collisions`."""
        return self._count
