"""What the parameters of the built-in scenes must be, said in their own names before anything is placed."""

from __future__ import annotations

import math

from kuglice.errors import SceneError
from kuglice.layout.group import MOST_BALLS

__all__ = ["at_least", "finite", "fraction_of_area", "positive", "whole"]


def whole(scene: str, *, least: int = 1, most: int | None = MOST_BALLS, **given: int) -> None:
    """Counts. Raises SceneError that names scene, parameter, value and bound, as all of these do."""
    for name, value in given.items():
        if not value >= least:
            raise _refused(scene, name, value, f"a whole number, at least {least}")
        if most is not None and value > most:
            raise _refused(scene, name, value, f"a whole number, at most {most:,}")


def positive(scene: str, **given: float) -> None:
    """Sizes and strengths that something is divided by or drawn from."""
    for name, value in given.items():
        if not 0.0 < value < math.inf:
            raise _refused(scene, name, value, "finite and greater than 0")


def fraction_of_area(scene: str, most: float, **given: float) -> None:
    """What balls may fill at most."""
    for name, value in given.items():
        if not 0.0 < value <= most:
            raise _refused(
                scene, name, value, f"greater than 0 and at most {most:.4g}: denser they cannot lie"
            )


def at_least(scene: str, least: float, **given: float) -> None:
    """Speeds and gaps."""
    for name, value in given.items():
        if not least <= value < math.inf:
            raise _refused(scene, name, value, f"finite and at least {least:g}")


def finite(scene: str, **given: float) -> None:
    """Of either sign."""
    for name, value in given.items():
        if not -math.inf < value < math.inf:
            raise _refused(scene, name, value, "finite")


def _refused(scene: str, name: str, value: float, bound: str) -> SceneError:
    return SceneError(f"scene {scene}: {name} = {value}: must be {bound}")
