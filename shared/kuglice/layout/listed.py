"""Balls given one by one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import BaseModel, ConfigDict, model_validator

from kuglice.balls import Balls
from kuglice.errors import SceneError
from kuglice.schema.problems import raises

__all__ = ["ListedGroup"]


@raises(SceneError)
class ListedGroup(BaseModel):
    """The arrays of Balls: position, radius, and perhaps velocity and mass."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    layout: Literal["listed"] = "listed"
    balls: Balls

    @model_validator(mode="before")
    @classmethod
    def _gather(cls, value: object) -> object:
        """In a file the arrays stand beside `layout`; Balls checks them."""
        if isinstance(value, Mapping) and "balls" not in value:
            return {
                "layout": "listed",
                "balls": {key: part for key, part in value.items() if key != "layout"},
            }
        return value

    def place(self, box: tuple[float, float, float, float], present: Balls) -> Balls:
        """Where they say."""
        return self.balls
