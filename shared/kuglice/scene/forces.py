"""Forces: each gives an acceleration a(t, state); `_core.FORCES` names the numbers that each one takes.

p, v, m: position, velocity and mass of a ball; d = p - (x, y).
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from kuglice.errors import SceneError
from kuglice.schema.numbers import NonNegative, Number, Positive
from kuglice.schema.problems import raises

__all__ = ["AttractForce", "Attractor", "Drag", "Force", "Gravity", "Spring", "ThrustForce"]

SCHEMA = ConfigDict(extra="forbid")


@raises(SceneError)
@dataclass(frozen=True, config=SCHEMA)
class Gravity:
    """Uniform: a = (x, y)."""

    x: Number
    y: Number
    kind: Literal["gravity"] = Field(default="gravity", kw_only=True)


@raises(SceneError)
@dataclass(frozen=True, config=SCHEMA)
class Drag:
    """Linear: a = -coefficient v / m."""

    coefficient: NonNegative
    kind: Literal["drag"] = Field(default="drag", kw_only=True)


@raises(SceneError)
@dataclass(frozen=True, config=SCHEMA)
class Attractor:
    """Softened point (Plummer): a = -strength d / (|d|^2 + softening^2)^(3/2). Negative strength repels."""

    x: Number
    y: Number
    strength: Number
    softening: Positive
    kind: Literal["attractor"] = Field(default="attractor", kw_only=True)


@raises(SceneError)
@dataclass(frozen=True, config=SCHEMA)
class Spring:
    """To a point: a = -stiffness d / m."""

    x: Number
    y: Number
    stiffness: NonNegative
    kind: Literal["spring"] = Field(default="spring", kw_only=True)


@raises(SceneError)
@dataclass(frozen=True, config=SCHEMA)
class ThrustForce:
    """The thrust (x, y) that a player holds acts on the player's ball: a = (x, y) / m."""

    kind: Literal["thrust"] = Field(default="thrust", kw_only=True)


@raises(SceneError)
@dataclass(frozen=True, config=SCHEMA)
class AttractForce:
    """Every point that a player holds attracts all balls, like Attractor with the held strength."""

    softening: Positive = 1.0
    kind: Literal["attract"] = Field(default="attract", kw_only=True)


Force = Annotated[
    Gravity | Drag | Attractor | Spring | ThrustForce | AttractForce,
    Field(discriminator="kind"),
]
