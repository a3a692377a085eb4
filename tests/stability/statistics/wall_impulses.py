"""Every wall hit of a world, one by one, seen from outside: by what it does to states.

The core counts wall hits and does not say what they gave. But discs only exchange momentum among themselves,
so a step with a single wall hit changes the sum by exactly what the wall gave. A step with more hits is taken
back and halved until each has its own.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

import kuglice as kg

Floats = NDArray[np.float64]


class WallImpulses:
    """Advance a world, handing out the impulse of each wall hit.

    With `alone`, hits are set apart from collisions too, and an impulse is that of the one ball that was
    hit, so that conservation of momentum in collisions is not taken for granted.
    """

    def __init__(
        self, world: kg.World, gravity: tuple[float, float] = (0.0, 0.0), alone: bool = False
    ) -> None:
        self._world = world
        self._gravity = np.array(gravity)
        self._alone = alone
        self._mass = world.mass

    def during(self, time: float, longest_step: float) -> Iterator[Floats]:
        """The hits of the next `time`: (2,) each."""
        steps = int(np.ceil(time / longest_step))
        for _ in range(steps):
            yield from self._within(time / steps)

    def _within(self, dt: float) -> Iterator[Floats]:
        world = self._world
        before = world.clone()
        world.step(dt=dt)
        hits = world.wall_hits - before.wall_hits
        if hits == 0:
            return
        if hits > 1 or (self._alone and world.collisions > before.collisions):
            world.copy_from(before)
            yield from self._within(dt / 2)
            yield from self._within(dt / 2)
        elif self._alone:
            change = world.velocity - before.velocity - self._gravity * dt
            ball = np.abs(change).sum(axis=1).argmax()
            yield self._mass[ball] * change[ball]
        else:
            yield np.array(world.momentum) - np.array(before.momentum) - self._mass.sum() * self._gravity * dt
