"""Number types of the schemas: finite, of the stated range, and never read from a string or a boolean."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import AllowInfNan, BeforeValidator, Discriminator, Field, Strict, Tag

__all__ = [
    "PAIR",
    "SINGLE",
    "Box",
    "Count",
    "Flag",
    "Fraction",
    "NonNegative",
    "Number",
    "OneOrTwo",
    "Point",
    "Positive",
    "Whole",
]


def _plain(value: object) -> object:
    """Strict validation knows Python's numbers only; numpy's scalars are numbers too."""
    return value.item() if isinstance(value, np.generic) else value


Number = Annotated[float, BeforeValidator(_plain), Strict(), AllowInfNan(False)]
Positive = Annotated[Number, Field(gt=0)]
NonNegative = Annotated[Number, Field(ge=0)]
Fraction = Annotated[Number, Field(ge=0, le=1)]
Whole = Annotated[int, BeforeValidator(_plain), Strict(), Field(ge=0)]
Count = Annotated[int, BeforeValidator(_plain), Strict(), Field(ge=1)]
Flag = Annotated[bool, Strict()]
Point = tuple[Number, Number]
Box = tuple[Number, Number, Number, Number]

SINGLE, PAIR = "one number", "two numbers"
OneOrTwo = Annotated[
    Annotated[Positive, Tag(SINGLE)] | Annotated[tuple[Positive, Positive], Tag(PAIR)],
    Discriminator(lambda value: PAIR if isinstance(value, list | tuple) else SINGLE),
]
"""Told apart beforehand: a plain union would report what is wrong with each of its members."""
