"""All layouts, and the placing of one group after the other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field, ValidationError

from kuglice.balls import Balls
from kuglice.errors import SceneError
from kuglice.layout.lattice import LatticeGroup
from kuglice.layout.listed import ListedGroup
from kuglice.layout.random import RandomGroup
from kuglice.layout.triangle import TriangleGroup
from kuglice.schema.problems import told, within

__all__ = ["Group", "place", "place_in_schema"]

Group = Annotated[
    RandomGroup | LatticeGroup | TriangleGroup | ListedGroup,
    Field(discriminator="layout"),
]


def place(groups: Iterable[Group], box: tuple[float, float, float, float]) -> Balls:
    """The balls of all groups, in order; a random group keeps clear of the groups before it.

    Raises SceneError if a group does not fit.
    """
    try:
        return place_in_schema(groups, box)
    except ValidationError as error:
        raise told(error, SceneError, "place") from None


def place_in_schema(groups: Iterable[Group], box: tuple[float, float, float, float]) -> Balls:
    """The same inside a validator, where problems are gathered with those of other keys."""
    placed = Balls.none()
    for index, group in enumerate(groups):
        with within("groups", index):
            placed = placed + group.place(box, placed)
    return placed
