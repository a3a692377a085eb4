"""Rows and columns."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from kuglice.balls import Balls
from kuglice.errors import SceneError
from kuglice.layout.group import MOST_BALLS, Placement
from kuglice.schema.numbers import Count, OneOrTwo, Point
from kuglice.schema.problems import Problem, raises, refusal

__all__ = ["LatticeGroup"]


@raises(SceneError)
class LatticeGroup(Placement):
    """`columns` x `rows` balls, the first at `origin`, then rightwards, then upwards.

    `spacing` is the distance of neighbouring columns, or [columns, rows]. A hexagonal lattice moves
    every other row by half a column and leaves out its last ball; unless said otherwise, its rows are
    sqrt(3)/2 of a column apart.
    """

    layout: Literal["lattice"] = "lattice"
    arrangement: Literal["square", "hexagonal"] = "square"
    columns: Annotated[Count, Field(le=MOST_BALLS)]
    rows: Annotated[Count, Field(le=MOST_BALLS)]
    origin: Point
    spacing: OneOrTwo

    def place(self, box: tuple[float, float, float, float], present: Balls) -> Balls:
        """On the lattice, whatever else is there."""
        if self.columns * self.rows > MOST_BALLS:
            bound = f"times columns = {self.columns} must be at most {MOST_BALLS}"
            raise refusal("group", [Problem(("rows",), self.rows, bound)])
        wide, high = self._steps()
        row, column = np.divmod(np.arange(self.columns * self.rows), self.columns)
        across = column * 1.0
        if self.arrangement == "hexagonal":
            odd = row % 2 == 1
            kept = ~(odd & (column == self.columns - 1))
            row, across = row[kept], (across + 0.5 * odd)[kept]
        position = np.empty((len(row), 2))
        position[:, 0] = self.origin[0] + across * wide
        position[:, 1] = self.origin[1] + row * high
        return self.balls(position, self.radii(len(row)))

    def _steps(self) -> tuple[float, float]:
        if isinstance(self.spacing, tuple):
            return self.spacing
        if self.arrangement == "hexagonal":
            return self.spacing, self.spacing * float(np.sqrt(3.0)) / 2.0
        return self.spacing, self.spacing
