"""The balls of a scene: structure of arrays, read-only, compared bit by bit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import GetCoreSchemaHandler, ValidationError
from pydantic_core import CoreSchema, core_schema

from kuglice.errors import SceneError
from kuglice.schema.problems import Problem, refuse, told

__all__ = ["PI", "Balls"]

PI = 3.141592653589793
"""Written out: a default mass must not depend on a library's constant."""
NAMES = ("position", "velocity", "radius", "mass")
SHOWN = 5
"""Wrong values that are listed per array; the rest is counted."""

Floats = NDArray[np.float64]


class Balls:
    """Balls in id order: position and velocity (n, 2), radius and mass (n,), all float64.

    Position says how many balls there are; scalars, and one row of two for velocity, are broadcast. Mass is
    pi radius^2 unless given; an infinite mass makes a peg. Raises SceneError for a shape, a type, a NaN, or
    a radius or mass that is not positive.
    """

    __slots__ = ("_mass", "_position", "_radius", "_velocity")

    def __init__(
        self,
        *,
        position: ArrayLike,
        radius: ArrayLike,
        velocity: ArrayLike = (0.0, 0.0),
        mass: ArrayLike | None = None,
    ) -> None:
        try:
            self._take(position, velocity, radius, mass)
        except ValidationError as error:
            raise told(error, SceneError, "Balls") from None

    def _take(self, position: object, velocity: object, radius: object, mass: object) -> None:
        problems: list[Problem] = []
        given = {"position": position, "velocity": velocity, "radius": radius, "mass": mass}
        arrays = {name: _numbers(name, value, problems) for name, value in given.items() if value is not None}
        refuse("Balls", problems)
        placed = arrays["position"]
        if placed.size and placed.ndim != 2:
            # One flat row would broadcast to as many balls as it has numbers.
            bound = "must have shape (n, 2), one row per ball"
            refuse("Balls", [Problem(("position",), f"shape {placed.shape}", bound)])
        # An empty list has no second dimension to tell.
        count = 0 if placed.size == 0 else len(placed)
        pairs, singles = (count, 2), (count,)
        if mass is None:
            # One expression, evaluated in this order, so that a default mass has the same bits everywhere.
            arrays["mass"] = PI * arrays["radius"] * arrays["radius"]
        self._position = _shaped("position", placed.reshape(0, 2) if count == 0 else placed, pairs, problems)
        self._velocity = _shaped("velocity", arrays["velocity"], pairs, problems)
        self._radius = _shaped("radius", arrays["radius"], singles, problems)
        self._mass = _shaped("mass", arrays["mass"], singles, problems)
        refuse("Balls", problems)
        problems += _bound("position", self._position, np.isfinite(self._position), "must be finite")
        problems += _bound("velocity", self._velocity, np.isfinite(self._velocity), "must be finite")
        good = (self._radius > 0) & np.isfinite(self._radius)
        problems += _bound("radius", self._radius, good, "must be finite and greater than 0")
        problems += _bound("mass", self._mass, self._mass > 0, "must be greater than 0 (inf makes a peg)")
        refuse("Balls", problems)

    @classmethod
    def none(cls) -> Balls:
        """No balls."""
        return cls(position=np.empty((0, 2)), radius=np.empty(0))

    @classmethod
    def concatenate(cls, parts: Iterable[Balls]) -> Balls:
        """One after the other; ids follow this order."""
        every = [cls.none(), *parts]
        return cls(**{name: np.concatenate([getattr(part, name) for part in every]) for name in NAMES})

    @property
    def position(self) -> Floats:
        """(n, 2), read-only."""
        return self._position

    @property
    def velocity(self) -> Floats:
        """(n, 2), read-only."""
        return self._velocity

    @property
    def radius(self) -> Floats:
        """(n,), read-only."""
        return self._radius

    @property
    def mass(self) -> Floats:
        """(n,), read-only; infinite for pegs."""
        return self._mass

    def __len__(self) -> int:
        return len(self._radius)

    def __add__(self, other: Balls) -> Balls:
        return Balls.concatenate([self, other])

    def __getitem__(self, chosen: slice | NDArray[Any]) -> Balls:
        return Balls(**{name: getattr(self, name)[chosen] for name in NAMES})

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Balls):
            return NotImplemented
        return self.to_message() == other.to_message()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Balls({len(self)})"

    def lists(self) -> dict[str, list[Any]]:
        """Each array as nested lists, for files that people read."""
        return {name: getattr(self, name).tolist() for name in NAMES}

    def to_message(self) -> dict[str, bytes]:
        """Little-endian float64 of each array: all bits are kept."""
        return {name: getattr(self, name).astype("<f8", copy=False).tobytes() for name in NAMES}

    @classmethod
    def from_message(cls, message: Mapping[str, bytes]) -> Balls:
        """Raises SceneError for anything that `to_message` would not make."""
        try:
            return cls._from_bytes(message)
        except ValidationError as error:
            raise told(error, SceneError, "Balls") from None

    @classmethod
    def _from_bytes(cls, message: Mapping[str, bytes]) -> Balls:
        problems = [
            Problem((name,), message.get(name), "must be a whole number of float64 values as bytes")
            for name in NAMES
            if not isinstance(message.get(name), bytes) or len(message[name]) % 8
        ]
        refuse("Balls", problems)
        flat = {name: np.frombuffer(message[name], "<f8") for name in NAMES}
        if flat["position"].size % 2 or flat["velocity"].size % 2:
            refuse("Balls", [Problem(("position",), flat["position"].size, "must hold pairs of numbers")])
        made = cls.__new__(cls)
        made._take(
            flat["position"].reshape(-1, 2), flat["velocity"].reshape(-1, 2), flat["radius"], flat["mass"]
        )
        return made

    @classmethod
    def __get_pydantic_core_schema__(cls, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            cls._validate,
            serialization=core_schema.plain_serializer_function_ser_schema(cls.lists, when_used="json"),
        )

    @classmethod
    def _validate(cls, value: object) -> Balls:
        if isinstance(value, Balls):
            return value
        if not isinstance(value, Mapping):
            raise ValueError(f"must be Balls or a table of {', '.join(NAMES)}")
        problems = [
            Problem((str(key),), value[key], f"no such key; balls have {', '.join(NAMES)}")
            for key in value
            if key not in NAMES
        ]
        problems += [Problem((key,), None, "missing") for key in ("position", "radius") if key not in value]
        refuse("Balls", problems)
        if all(isinstance(part, bytes) for part in value.values()):
            return cls._from_bytes(value)
        made = cls.__new__(cls)
        made._take(value["position"], value.get("velocity", (0.0, 0.0)), value["radius"], value.get("mass"))
        return made


def _numbers(name: str, value: object, problems: list[Problem]) -> Floats:
    """As float64; strings and booleans are refused, which numpy would convert."""
    try:
        array = np.asarray(value)
    except ValueError:
        array = np.asarray("ragged")
    if array.dtype.kind not in "iuf":
        problems.append(Problem((name,), value, "must be numbers, in rows of equal length"))
        return np.empty(0)
    return array.astype(np.float64)


def _shaped(name: str, array: Floats, shape: tuple[int, ...], problems: list[Problem]) -> Floats:
    """A read-only copy of that shape."""
    try:
        whole = np.broadcast_to(array, shape).copy()
    except ValueError:
        problems.append(Problem((name,), f"shape {array.shape}", f"must have shape {shape}"))
        return np.empty(shape)
    whole.flags.writeable = False
    return whole


def _bound(name: str, array: Floats, good: NDArray[np.bool_], bound: str) -> list[Problem]:
    if good.all():
        return []
    wrong = np.argwhere(~good)
    problems = [
        Problem((name, *(int(part) for part in index)), float(array[tuple(index)]), bound)
        for index in wrong[:SHOWN]
    ]
    if len(wrong) > SHOWN:
        problems.append(Problem((name,), f"{len(wrong) - SHOWN} more values", bound))
    return problems
