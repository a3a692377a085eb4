"""Hard discs press on their walls as ten virial coefficients say."""

from __future__ import annotations

import numpy as np
import pytest

from stability.statistics.estimate import Estimate, extrapolate, of_blocks
from stability.statistics.hard_discs import accessible_side, compressibility, gas
from stability.statistics.wall_impulses import WallImpulses

BLOCKS = 20
HITS = {10: 40_000, 20: 40_000}
"""Length of a run, per side of the square of n = 100 and 400 discs."""


def measured(rows: int, packing: float) -> Estimate:
    """Z = p A / (N kT) by the mean impulse per time and accessible length of wall."""
    count = rows * rows
    side = accessible_side(count, packing)
    world = gas(rows, packing, seed=rows)
    walls = WallImpulses(world)
    # An ideal gas of contact density Z n hits a wall so often per time and length.
    hits_per_time = 4 * side * compressibility(packing) * count / side**2 / np.sqrt(2 * np.pi)
    time = HITS[rows] / hits_per_time / BLOCKS
    blocks = []
    for _ in range(BLOCKS):
        impulse = sum(float(np.abs(hit).sum()) for hit in walls.during(time, 0.5 / hits_per_time))
        blocks.append(impulse / (4 * side * time) * side**2 / count)
    return of_blocks(blocks)


@pytest.mark.parametrize("packing", [0.1, 0.2, 0.3])
def test_pressure_on_the_walls_is_that_of_theory(packing):
    sizes = [(rows * rows, measured(rows, packing)) for rows in HITS]
    z = extrapolate(*sizes)
    expected = compressibility(packing)
    assert z.sigmas(expected) < 3, f"{z}, theory {expected}, sizes {sizes}"
    assert z.error < 0.005 * expected, "a test that would not notice 1.5 %"
