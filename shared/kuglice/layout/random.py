"""At random without overlap."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from kuglice.balls import PI, Balls
from kuglice.errors import SceneError
from kuglice.layout.group import MOST_BALLS, Placement
from kuglice.layout.sequential import add_sequentially
from kuglice.layout.slot_grid import SlotGrid
from kuglice.layout.stream import POSITION, RandomStream
from kuglice.layout.thermal import melt
from kuglice.schema.numbers import Box, Count
from kuglice.schema.problems import Problem, raises, refusal

__all__ = ["RandomGroup"]

DENSE = 0.33
"""From this packing on, discs of one size start from a melted lattice: proposals would mostly be refused."""


@raises(SceneError)
class RandomGroup(Placement):
    """`count` balls anywhere in `area` (the box unless given), clear of each other and of the groups before.

    Discs of one size reach a packing of about 0.8, sizes that differ about 0.5. From a packing of 0.33 on, discs of
    one size are no random places but a melted lattice: a hexagonal one with vacancies, after 4 to 50 sweeps of small
    moves, the fewer the more discs (see kuglice.layout.thermal). Some of its order is left until they have collided.
    """

    layout: Literal["random"] = "random"
    count: Annotated[Count, Field(le=MOST_BALLS)]
    area: Box | None = None
    """Left, bottom, right, top."""

    def place(self, box: tuple[float, float, float, float], present: Balls) -> Balls:
        """Where there is room; a count that finds none is refused."""
        area = self._area(box)
        left, bottom, right, top = area
        radius = self.radii(self.count)
        packing = float(np.add.accumulate(radius * radius)[-1]) * PI / ((right - left) * (top - bottom))
        obstacles = [_grid(area, present)] if len(present) else []
        stream = RandomStream(self.seed, POSITION)
        position = None
        if packing < 1.0:
            if packing >= DENSE and not isinstance(self.radius, tuple):
                position = melt(area, self.radius, self.count, obstacles, stream)
            else:
                position = add_sequentially(area, radius, obstacles, stream)
        if position is None:
            bound = f"does not fit: these balls would fill {packing:.3g} of the area {list(area)}"
            raise refusal("group", [Problem(("count",), self.count, bound)])
        return self.balls(position, radius)

    def _area(self, box: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
        area = box if self.area is None else self.area
        width, height = area[2] - area[0], area[3] - area[1]
        least = 2.0 * self.largest_radius()
        if width < least or height < least:
            name = "box" if self.area is None else "area"
            bound = f"must be at least {least:.6g} wide and high, the diameter of the largest ball"
            raise refusal("group", [Problem((name,), list(area), bound)])
        return area


def _grid(area: tuple[float, float, float, float], present: Balls) -> SlotGrid:
    """Over the area and all that is present, which may lie beside it."""
    low, high = present.position.min(axis=0), present.position.max(axis=0)
    left, bottom, right, top = area
    whole = (
        min(left, float(low[0])),
        min(bottom, float(low[1])),
        max(right, float(high[0])),
        max(top, float(high[1])),
    )
    grid = SlotGrid(whole, float(present.radius.min()), float(present.radius.max()), len(present))
    grid.insert(present.position, present.radius)
    return grid
