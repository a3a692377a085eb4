"""What clients may do to a scene, and how much of it."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

from kuglice.errors import SceneError
from kuglice.schema.numbers import Count, Flag, NonNegative, Positive
from kuglice.schema.problems import raises

__all__ = ["InputLimits", "SpawnLimits"]


@raises(SceneError)
class SpawnLimits(BaseModel):
    """Bounds of a ball that a client may add."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    max_radius: Positive = 1.0
    max_mass: Positive = 10.0
    max_speed: NonNegative = 10.0


@raises(SceneError)
class InputLimits(BaseModel):
    """Bounds of each kind of input; None refuses the kind."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    thrust: Positive | None = None
    """Largest force."""
    attract: Positive | None = None
    """Largest absolute strength."""
    kick: Positive | None = None
    """Largest change of speed."""
    spawn: SpawnLimits | None = None
    remove: Flag = False
    max_balls: Count = 100_000
    """Spawns and joins are refused at this number of balls."""
    per_tick: Count = 16
    """Inputs per client and tick."""
