"""Newton's cradle without strings."""

from __future__ import annotations

from kuglice.layout import LatticeGroup, ListedGroup
from kuglice.scene import Balls, Scene
from kuglice.scenes.bounds import at_least, finite, whole

__all__ = ["cradle"]


def cradle(n: int = 5, speed: float = 8.0, gap: float = 0.05) -> Scene:
    """n equal balls at rest in a row, and one more that hits them."""
    whole("cradle", n=n)
    finite("cradle", speed=speed)
    at_least("cradle", 0.0, gap=gap)
    width = max(24.0, 2.0 * n + 14.0)
    spacing = 1.0 + gap
    first = 0.5 * (width - (n - 1) * spacing)
    return Scene(
        title="Cradle",
        description="One ball goes in and exactly one comes out: equal masses exchange their velocities.",
        box=(0.0, 0.0, width, 6.0),
        tick_rate=240.0,
        groups=(
            ListedGroup(balls=Balls(position=[(1.5, 3.0)], velocity=[(speed, 0.0)], radius=0.5)),
            # Simultaneous contacts have no unique outcome, so neighbours keep a gap.
            LatticeGroup(columns=n, rows=1, origin=(first, 3.0), spacing=spacing, radius=0.5),
        ),
    )
