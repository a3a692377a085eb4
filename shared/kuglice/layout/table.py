"""All layouts, and the placing of one group after the other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from kuglice.balls import Balls
from kuglice.layout.lattice import LatticeGroup
from kuglice.layout.listed import ListedGroup
from kuglice.layout.random import RandomGroup
from kuglice.layout.triangle import TriangleGroup
from kuglice.schema.problems import within

__all__ = ["Group", "place"]

Group = Annotated[
    RandomGroup | LatticeGroup | TriangleGroup | ListedGroup,
    Field(discriminator="layout"),
]


def place(groups: Iterable[Group], box: tuple[float, float, float, float]) -> Balls:
    """The balls of all groups, in order; a random group keeps clear of the groups before it."""
    placed = Balls.none()
    for index, group in enumerate(groups):
        with within("groups", index):
            placed = placed + group.place(box, placed)
    return placed
