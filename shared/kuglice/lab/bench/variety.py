"""Gravity and mixed radii, beside equal balls without: same number, same packing, same ticks, same round."""

from __future__ import annotations

import math
from collections.abc import Mapping

from kuglice.balls import PI
from kuglice.lab.bench.case import Contender, Measure, raced
from kuglice.lab.bench.stepping import OURS, contender, settled
from kuglice.layout import RandomGroup
from kuglice.scene import Gravity, Scene
from kuglice.scenes import gas, rain

__all__ = ["CASES"]

BALLS = 10_000
PACKING = 0.3
TICKS = 100
SETTLING_SECONDS = 10.0
"""At first rain meets nothing but air, and then the floor all at once."""
WEAK = 0.1
"""m/s^2: the heat of the gas holds up against it, so that its balls meet as often as without."""


def _radii(least: float, greatest: float) -> Scene:
    """A gas of radii spread evenly between two."""
    mean_square = (greatest**3 - least**3) / (3.0 * (greatest - least))
    height = math.sqrt(BALLS * PI * mean_square / PACKING * 9.0 / 16.0)
    return Scene(
        title=f"Gas of radii {least:g} to {greatest:g}",
        box=(0.0, 0.0, height * 16.0 / 9.0, height),
        groups=(RandomGroup(count=BALLS, radius=(least, greatest), speed=5.0, seed=1),),
    )


def _falling() -> Mapping[str, Contender]:
    scenes = {
        "gas": gas(n=BALLS, packing=PACKING),
        "gas under gravity": gas(n=BALLS, packing=PACKING).model_copy(
            update={"forces": (Gravity(0.0, -WEAK),)}
        ),
        "rain": settled(rain(n=BALLS, radius=0.08), SETTLING_SECONDS),
    }
    return {name: contender(scene, OURS["event"], TICKS) for name, scene in scenes.items()}


def _mixed() -> Mapping[str, Contender]:
    scenes = {
        "radii equal": gas(n=BALLS, packing=PACKING),
        "radii 0.1 to 2": _radii(0.1, 2.0),
        "radii 0.01 to 10": _radii(0.01, 10.0),
    }
    return {
        f"{name}, {contacts}": contender(scene, OURS[contacts], TICKS)
        for contacts in ("overlap", "event")
        for name, scene in scenes.items()
    }


CASES: dict[str, Measure] = {
    f"gravity, {BALLS:,}, event": raced(_falling),
    f"radii, {BALLS:,}": raced(_mixed),
}
