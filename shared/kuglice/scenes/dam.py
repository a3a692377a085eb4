"""A dam that breaks."""

from __future__ import annotations

from kuglice.layout import RandomGroup
from kuglice.scene import Gravity, Scene
from kuglice.scenes.bounds import whole

__all__ = ["dam"]


def dam(n: int = 10_000, seed: int = 1) -> Scene:
    """n small balls, let go as a column of fluid at the left end of a tank."""
    whole("dam", n=n)
    whole("dam", least=0, most=None, seed=seed)
    return Scene(
        title="Dam",
        description="Ten thousand small balls, let go as a column, run through the tank as a fluid.",
        box=(0.0, 0.0, 32.0, 18.0),
        restitution=0.98,
        tick_rate=240.0,
        forces=(Gravity(0.0, -10.0),),
        groups=(RandomGroup(count=n, radius=0.05, seed=seed, speed=0.5, area=(0.0, 0.0, 10.0, 14.0)),),
    )
