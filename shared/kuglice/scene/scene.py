"""Scene: what is there, and what it demands. A frozen schema whose instances are always valid."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from os import PathLike
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from kuglice import _core
from kuglice.balls import Balls
from kuglice.errors import SceneError
from kuglice.layout.table import Group, place_in_schema
from kuglice.scene.forces import Force
from kuglice.scene.limits import InputLimits
from kuglice.scene.pins import ModelPins
from kuglice.scene.players import PlayerRules
from kuglice.scene.start import check_start
from kuglice.schema.numbers import Box, Flag, Fraction, Positive
from kuglice.schema.problems import Problem, raises, refusal, told

__all__ = ["Scene"]


def _accuracy(value: object) -> object:
    """One finding, where a union would report each of its members."""
    number = isinstance(value, int | float) and not isinstance(value, bool) and 0 < value < inf
    if value in ("visual", "faithful", "exact") or number:
        return value
    raise ValueError('must be "visual", "faithful", "exact", or a largest error in radii greater than 0')


Accuracy = Annotated[Literal["visual", "faithful", "exact"] | float, BeforeValidator(_accuracy)]


@raises(SceneError)
class Scene(BaseModel):
    """Balls in a box (left, bottom, right, top), the forces on them, and what clients may do.

    Give either `balls` or `groups`: recipes from which the balls are placed. Raises SceneError, which lists
    every problem with its key, value and bound: a wrong key, type, range or NaN, a ball outside the box, and
    an overlap at the start unless `allow_overlap`.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    title: str = ""
    description: str = ""
    box: Box
    walls: Flag = True
    """Whether the sides of the box hold balls in; without walls they fly on. There are no periodic boundaries: what
    leaves on one side never comes in on the other."""
    restitution: Fraction = 1.0
    tick_rate: Annotated[Positive, Field(le=1e6)] = 60.0
    """Ticks per second."""
    forces: tuple[Force, ...] = ()
    groups: tuple[Group, ...] = ()
    balls: Balls = Field(default_factory=Balls.none)
    limits: InputLimits = InputLimits()
    players: PlayerRules | None = None
    allow_overlap: Flag = False
    model: ModelPins = ModelPins()
    accuracy: Accuracy = "visual"
    """"visual", "faithful" or "exact", or the largest error of a position that is accepted, in radii, when
    the mean ball has collided once or a second has passed (see kuglice.planner.demand)."""
    budget_ms: Positive | None = None
    """Milliseconds that one tick may take."""

    @model_validator(mode="after")
    def _settle(self) -> Self:
        if self.groups:
            placed = place_in_schema(self.groups, self.box)
            if len(self.balls) and self.balls != placed:
                bound = "give balls or groups, not both: a group of layout listed holds single balls"
                raise refusal("Scene", [Problem(("balls",), self.balls, bound)])
            object.__setattr__(self, "balls", placed)
        check_start(self)
        return self

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """A scene that differs in some keys, validated like any other. Raises SceneError.

        Groups are placed again if they or the box differ. Balls that are given replace groups.
        """
        if not update:
            return super().model_copy(deep=deep)
        given = {name: getattr(self, name) for name in type(self).model_fields} | dict(update)
        groups = given.pop("groups")
        if "balls" in update and "groups" not in update:
            groups = ()
        if groups and not {"groups", "box"}.isdisjoint(update):
            if "balls" not in update:
                del given["balls"]
            return type(self)(**given, groups=groups)
        # To place them again would find the same balls.
        copy = type(self)(**given)
        object.__setattr__(copy, "groups", groups)
        return copy

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Scene:
        """Read a TOML file. Raises SceneError, also when the file cannot be read."""
        from kuglice.scene.file import read_scene  # noqa: PLC0415 - it makes a Scene

        return read_scene(path)

    def save(self, path: str | PathLike[str]) -> None:
        """Write a TOML file that loads to an equal scene, bit for bit."""
        from kuglice.scene.file import write_scene  # noqa: PLC0415 - it needs layouts

        write_scene(self, path)

    def to_message(self) -> dict[str, Any]:
        """Values that msgpack knows; arrays as little-endian bytes of all bits. Groups become balls."""
        message = self.model_dump(mode="python", exclude={"balls", "groups"})
        message["balls"] = self.balls.to_message()
        return message

    @classmethod
    def from_message(cls, message: Mapping[str, Any]) -> Scene:
        """Raises SceneError for anything that is not a valid scene."""
        try:
            return cls.model_validate(message)
        except ValidationError as error:
            raise told(error, SceneError, "scene message", cls.model_fields) from None

    def rules(self) -> _core.Rules:
        """The part that never changes in a world, for the compiled core."""
        return _core.Rules(
            box=self.box,
            walls=self.walls,
            restitution=self.restitution,
            tick_rate=self.tick_rate,
            forces=[
                (force.kind, [float(getattr(force, name)) for name in _core.FORCES[force.kind]])
                for force in self.forces
            ],
        )

    def _repr_png_(self) -> bytes | None:
        from kuglice.world import World  # noqa: PLC0415 - a World is made of a Scene

        return World(self)._repr_png_()
