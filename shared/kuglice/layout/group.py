"""What the layouts have in common: which balls, and how they move at the start."""

from __future__ import annotations

from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import AllowInfNan, BaseModel, ConfigDict, Field, Strict, model_validator

from kuglice.balls import PI, Balls
from kuglice.layout.stream import DIRECTION, RADIUS, RandomStream, directions
from kuglice.schema.numbers import NonNegative, OneOrTwo, Point, Positive, Whole
from kuglice.schema.problems import Problem, refuse

__all__ = ["MOST_BALLS", "Floats", "Placement"]

MOST_BALLS = 10_000_000
"""Of one group."""

Floats = NDArray[np.float64]
Mass = Annotated[float, Strict(), AllowInfNan(True), Field(gt=0)]


class Placement(BaseModel):
    """Radius, mass and velocity of the balls of one group; each layout adds where they lie."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    radius: OneOrTwo
    """One radius, or [smallest, largest] for radii spread evenly at random."""
    mass: Mass | None = None
    """Of every ball; inf makes pegs. None: from density."""
    density: Positive = 1.0
    """Mass per area."""
    velocity: Point = (0.0, 0.0)
    speed: NonNegative = 0.0
    """In random directions, added to `velocity`."""
    seed: Annotated[Whole, Field(le=2**64 - 1)] = 1

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if isinstance(self.radius, tuple) and self.radius[0] > self.radius[1]:
            bound = "must be [smallest, largest]"
            refuse("group", [Problem(("radius",), self.radius, bound)])
        return self

    def radii(self, count: int) -> Floats:
        """(count,) radii."""
        if not isinstance(self.radius, tuple):
            return np.full(count, self.radius)
        smallest, largest = self.radius
        return smallest + (largest - smallest) * RandomStream(self.seed, RADIUS).take(count)

    def largest_radius(self) -> float:
        """Upper bound of the radii."""
        return self.radius[1] if isinstance(self.radius, tuple) else self.radius

    def balls(self, position: Floats, radius: Floats) -> Balls:
        """Give mass and velocity to placed discs."""
        mass = self.density * PI * radius * radius if self.mass is None else np.full(len(radius), self.mass)
        velocity = np.empty((len(radius), 2))
        velocity[:] = self.velocity
        if self.speed:
            velocity += self.speed * directions(RandomStream(self.seed, DIRECTION), len(radius))
        return Balls(position=position, velocity=velocity, radius=radius, mass=mass)
