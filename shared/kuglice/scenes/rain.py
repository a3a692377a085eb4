"""Rain on a floor."""

from __future__ import annotations

from kuglice.layout import RandomGroup
from kuglice.scene import Gravity, Scene
from kuglice.scenes.bounds import finite, positive, whole

__all__ = ["rain"]


def rain(n: int = 2000, seed: int = 1, radius: float = 0.15, gravity: float = 10.0) -> Scene:
    """n elastic balls that fall from the upper half of a box and never come to rest."""
    whole("rain", n=n)
    whole("rain", least=0, most=None, seed=seed)
    positive("rain", radius=radius)
    finite("rain", gravity=gravity)
    return Scene(
        title="Rain",
        description="Elastic drops fall, bounce and spread until their density follows the barometric law.",
        box=(0.0, 0.0, 48.0, 27.0),
        tick_rate=120.0,
        forces=(Gravity(0.0, -gravity),),
        groups=(RandomGroup(count=n, radius=radius, speed=0.5, seed=seed, area=(0.0, 12.0, 48.0, 27.0)),),
    )
