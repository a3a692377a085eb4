"""A Galton board."""

from __future__ import annotations

import math

from kuglice.layout import LatticeGroup, RandomGroup
from kuglice.scene import Gravity, Scene
from kuglice.scenes.bounds import whole

__all__ = ["pegs"]


def pegs(n: int = 400, rows: int = 14, seed: int = 1) -> Scene:
    """n balls fall through rows of fixed pegs into bins."""
    whole("pegs", n=n, rows=rows)
    whole("pegs", least=0, most=None, seed=seed)
    columns, spacing = 24, 2.0
    width, bins, board = columns * spacing, 8.0, rows * 1.6
    height = bins + board + 1.0 + n / 20.0
    middle = 0.5 * width
    return Scene(
        title="Pegs",
        description="Balls that fall through a lattice of pegs fill the bins below in a bell curve.",
        box=(0.0, 0.0, width, height),
        restitution=0.5,
        tick_rate=240.0,
        forces=(Gravity(0.0, -10.0),),
        groups=(
            # A column of pegs that touch is the wall between two bins.
            LatticeGroup(
                columns=columns - 1,
                rows=int(bins / 0.25),
                origin=(spacing, 0.1),
                spacing=(spacing, 0.25),
                radius=0.125,
                mass=math.inf,
            ),
            LatticeGroup(
                arrangement="hexagonal",
                columns=columns - 1,
                rows=rows,
                origin=(spacing, bins + 1.0),
                spacing=(spacing, 1.6),
                radius=0.25,
                mass=math.inf,
            ),
            RandomGroup(
                count=n,
                radius=0.2,
                seed=seed,
                speed=0.5,
                area=(middle - 4.0, bins + board + 1.0, middle + 4.0, height),
            ),
        ),
    )
