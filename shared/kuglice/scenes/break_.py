"""The break of a very large rack. Its registered name is "break", which Python reserves."""

from __future__ import annotations

import math

from kuglice.layout import ListedGroup, TriangleGroup
from kuglice.scene import Balls, Scene
from kuglice.scenes.bounds import at_least, finite, whole

__all__ = ["break_"]


def break_(rows: int = 100, speed: float = 120.0, gap: float = 0.02) -> Scene:
    """A fast heavy ball into a triangle of rows (rows + 1) / 2 balls: 5,050 for 100 rows."""
    whole("break", rows=rows)
    finite("break", speed=speed)
    at_least("break", 0.0, gap=gap)
    spacing = 1.0 + gap
    deep = rows * spacing * math.sqrt(3.0) / 2.0
    height = 1.5 * max(rows * spacing, 12.0)
    width = height * 16.0 / 9.0
    apex = (0.5 * (width - deep), 0.5 * height)
    cue = Balls(position=[(6.0, 0.5 * height + 0.25)], velocity=[(speed, 0.0)], radius=3.0)
    return Scene(
        title="Break",
        description="One fast ball opens a rack of thousands: a shock runs through balls that almost touch.",
        box=(0.0, 0.0, width, height),
        tick_rate=240.0,
        groups=(
            ListedGroup(balls=cue),
            TriangleGroup(rows=rows, apex=apex, spacing=spacing, radius=0.5),
        ),
    )
