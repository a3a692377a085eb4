"""Balls of very different sizes."""

from __future__ import annotations

from kuglice.layout import RandomGroup
from kuglice.scene import Scene

__all__ = ["mixed"]


def mixed(n: int = 1200, seed: int = 1, speed: float = 4.0) -> Scene:
    """n balls of radii 0.1 to 2, a hundredfold to four hundredfold in mass."""
    return Scene(
        title="Mixed",
        description="Radii from 0.1 to 2: in the long run small balls are fast and large ones slow.",
        box=(0.0, 0.0, 160.0, 90.0),
        groups=(RandomGroup(count=n, radius=(0.1, 2.0), speed=speed, seed=seed),),
    )
