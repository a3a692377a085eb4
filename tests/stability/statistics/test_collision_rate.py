"""Hard discs between walls collide as often as Enskog's formula with ten virial coefficients says."""

from __future__ import annotations

import pytest

from stability.statistics.estimate import Estimate, extrapolate, of_blocks
from stability.statistics.hard_discs import collisions_per_disc_and_time, gas, relative_speed_in_closed_box

BLOCKS = 20
COLLISIONS_PER_DISC = {16: 2400, 32: 1500}
"""Length of a run, per side of the square of n = 256 and 1024 discs."""


def measured(rows: int, packing: float) -> Estimate:
    count = rows * rows
    world = gas(rows, packing, seed=rows)
    ticks = round(COLLISIONS_PER_DISC[rows] / collisions_per_disc_and_time(packing) / BLOCKS)
    rates = []
    for _ in range(BLOCKS):
        before = world.collisions
        world.run(ticks)
        rates.append(2 * (world.collisions - before) / (count * ticks) / relative_speed_in_closed_box(count))
    return of_blocks(rates)


@pytest.mark.parametrize("packing", [0.1, 0.2, 0.3])
def test_collision_rate_is_that_of_theory(packing):
    sizes = [(rows * rows, measured(rows, packing)) for rows in COLLISIONS_PER_DISC]
    rate = extrapolate(*sizes)
    expected = collisions_per_disc_and_time(packing)
    assert rate.sigmas(expected) < 3, f"{rate}, theory {expected}, sizes {sizes}"
    assert rate.error < 0.005 * expected, "a test that would not notice 1.5 %"
