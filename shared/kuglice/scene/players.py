"""The ball that a client gets when it joins."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from kuglice.errors import SceneError
from kuglice.schema.numbers import Count, Point, Positive
from kuglice.schema.problems import raises

__all__ = ["PlayerRules"]


@raises(SceneError)
class PlayerRules(BaseModel):
    """A scene with these gives every client a ball of this radius and mass at one of the spawn points."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    radius: Positive
    mass: Positive
    spawn_points: Annotated[tuple[Point, ...], Field(min_length=1)]
    max_players: Count = 64
