"""What a view must know before it can look: a scene without its balls, and how regions are told."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import BaseModel, ConfigDict, Field

from kuglice import _core
from kuglice.protocol.messages.about import AboutWorld
from kuglice.protocol.messages.envelope import MAX_WHOLE_BYTES
from kuglice.protocol.nodes import Rectangle

__all__ = ["PACES", "RegionTerms", "ViewAbout"]

PACES = 5
"""Keys of each node: at pace p it is told rate / 2^p times per second."""

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Shape = Annotated[tuple[Positive, Annotated[float, Field(gt=0)]], Field(strict=False)]


class RegionTerms(BaseModel):
    """How regions are told.

    The quadtree has `depth` levels below the box. Positions are whole multiples of `position_quantum` (metres)
    from the left bottom of the box and velocities of `velocity_quantum` (metres per second): each coordinate is
    told with an error of at most half of that. `rate`: times per second at pace 0. `shapes`: the (radius, mass)
    that a message names by number; others are told with a radius of 24 bits.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    depth: Annotated[int, Field(ge=1, le=_core.MOST_DEPTH)]
    rate: Positive
    position_quantum: Positive
    velocity_quantum: Positive
    shapes: Annotated[list[Shape], Field(max_length=_core.MOST_SHAPES)]

    def packer(self, box: Rectangle) -> _core.Regions:
        """What packs and unpacks by these terms. Raises ProtocolError for a quantum that cannot be."""
        return _core.Regions(
            box=box,
            depth=self.depth,
            position_quantum=self.position_quantum,
            velocity_quantum=self.velocity_quantum,
            shapes=self.shapes,
        )


class ViewAbout(AboutWorld):
    """For those who look at a part: its size does not grow with the balls.

    `scene` has none of them, `balls` says how many play; `reference_speed` is the scene's, so that pictures
    agree.
    """

    kind: ClassVar[str] = "view about"
    max_bytes: ClassVar[int] = MAX_WHOLE_BYTES

    balls: Annotated[int, Field(ge=0)]
    reference_speed: Positive
    regions: RegionTerms
