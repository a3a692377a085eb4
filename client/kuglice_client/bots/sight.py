"""What a bot sees, and the arithmetic of steering by it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kuglice import World
from kuglice.inputs import Input, Thrust

__all__ = ["Bot", "Sight"]

Vector = NDArray[np.float64]

STEPS = 16
"""Of thrust, from none to all: a bot that hardly changes its mind has nothing to say."""


@dataclass(frozen=True)
class Sight:
    """The predicted world, before the tick that the bot decides about.

    `own`: id of its ball, if it has one.
    """

    world: World
    own: int | None

    @property
    def time(self) -> float:
        """Seconds of the scene."""
        return self.world.time

    @cached_property
    def box(self) -> tuple[Vector, Vector]:
        """Lower left and upper right corner."""
        left, bottom, right, top = self.world.scene.box
        return np.array([left, bottom]), np.array([right, top])

    @cached_property
    def ids(self) -> NDArray[np.uint64]:
        """(n,)."""
        return self.world.id

    @cached_property
    def positions(self) -> Vector:
        """(n, 2)."""
        return self.world.position

    @cached_property
    def velocities(self) -> Vector:
        """(n, 2)."""
        return self.world.velocity

    @cached_property
    def index(self) -> int | None:
        """Row of the own ball."""
        if self.own is None:
            return None
        found = np.flatnonzero(self.ids == self.own)
        return int(found[0]) if len(found) else None

    @cached_property
    def rivals(self) -> list[int]:
        """Rows of the other players' balls."""
        theirs = [ball for _, ball in self.world.players if ball is not None and ball != self.own]
        return np.flatnonzero(np.isin(self.ids, np.array(theirs, dtype=np.uint64))).tolist()

    def towards(self, velocity: Vector, *, seconds: float) -> Input | None:
        """The thrust that brings the own ball to `velocity` in about that time, as far as allowed."""
        limit = self.world.scene.limits.thrust
        if self.index is None or limit is None:
            return None
        force = float(self.world.mass[self.index]) * (velocity - self.velocities[self.index]) / seconds
        length = float(np.hypot(*force))
        if length > limit:
            force = force * (limit / length)
        # Towards 0, so that it stays within the bound that the server checks.
        force = np.trunc(force * (STEPS / limit)) * (limit / STEPS)
        return Thrust(x=float(force[0]), y=float(force[1]))


Bot = Callable[[Sight], Input | None]
"""Called a few times per second; the input that it returns is held until the next one."""
