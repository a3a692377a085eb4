"""A rack, as in billiards."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from kuglice.balls import Balls
from kuglice.errors import SceneError
from kuglice.layout.group import Placement
from kuglice.schema.numbers import Count, Point, Positive
from kuglice.schema.problems import raises

__all__ = ["TriangleGroup"]


@raises(SceneError)
class TriangleGroup(Placement):
    """`rows` rows of 1, 2, 3, ... balls, the first at `apex`, the rest rightwards of it, `spacing` apart."""

    layout: Literal["triangle"] = "triangle"
    rows: Annotated[Count, Field(le=4_000)]
    apex: Point
    spacing: Positive

    def place(self, box: tuple[float, float, float, float], present: Balls) -> Balls:
        """Row by row, each from the bottom upwards."""
        row = np.repeat(np.arange(self.rows), np.arange(1, self.rows + 1))
        first = row * (row + 1) // 2
        inside = np.arange(len(row)) - first
        position = np.empty((len(row), 2))
        position[:, 0] = self.apex[0] + row * (self.spacing * float(np.sqrt(3.0)) / 2.0)
        position[:, 1] = self.apex[1] + (inside - 0.5 * row) * self.spacing
        return self.balls(position, self.radii(len(row)))
