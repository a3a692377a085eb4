"""What a view looks at, and how much it may cost."""

from __future__ import annotations

import math
from dataclasses import dataclass

from kuglice.errors import ProtocolError
from kuglice.protocol import DEFAULT_ENDPOINT, Rectangle, check_endpoints, check_name

__all__ = ["ViewSettings", "check_rectangle", "parse_rectangle"]

FARTHEST = 1e12
"""Metres; beyond, neighbouring numbers are farther apart than balls are large."""


@dataclass(frozen=True)
class ViewSettings:
    """`rectangle`: left, bottom, right, top in metres of the scene.

    `margin`: metres around it that are followed too, for what comes in from there (None: half the shorter
    side of a node). `budget`: bytes of payload per second (None: as many as there are). `wait`: seconds
    that joining may take. Raises ProtocolError for numbers that cannot be.
    """

    rectangle: Rectangle
    connect: tuple[str, ...] = (DEFAULT_ENDPOINT,)
    world: str | None = None
    margin: float | None = None
    budget: float | None = None
    wait: float = 10.0

    def __post_init__(self) -> None:
        check_endpoints(self.connect)
        if self.world is not None:
            check_name("world", self.world)
        check_rectangle(self.rectangle)
        if self.margin is not None and not 0 <= self.margin < math.inf:
            raise ProtocolError(f"margin {self.margin:g}: must be at least 0 and finite")
        if self.budget is not None and not self.budget > 0:
            raise ProtocolError(f"budget {self.budget:g}: must be above 0 bytes per second")
        if not self.wait >= 0:
            raise ProtocolError(f"wait {self.wait:g}: must be at least 0 seconds")


def check_rectangle(rectangle: Rectangle) -> Rectangle:
    """As it is; raises ProtocolError if it is none."""
    left, bottom, right, top = rectangle
    if not (all(abs(edge) <= FARTHEST for edge in rectangle) and left < right and bottom < top):
        raise ProtocolError(f"view {rectangle}: must be within {FARTHEST:g} m, its width and height above 0")
    return rectangle


def parse_rectangle(text: str) -> Rectangle:
    """ "X,Y,WIDTH,HEIGHT", X and Y the left bottom corner -> left, bottom, right, top. Raises ProtocolError."""
    try:
        x, y, width, height = map(float, text.split(","))
    except ValueError:
        raise ProtocolError(f"view {text!r}: must be four numbers X,Y,WIDTH,HEIGHT") from None
    if width <= 0 or height <= 0:
        raise ProtocolError(f"view {text!r}: width and height must be above 0")
    return check_rectangle((x, y, x + width, y + height))
