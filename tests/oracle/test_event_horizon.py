"""`event` can be followed for as long as 53 bits allow: its predictability horizon is the oracle's own at
53 bits.

Measured (32 equal discs, walls, mean of 10 seeds) at packing 0.05, 0.3 and 0.6: the oracle 7.7, 27.3 and 63.5
collisions per disc, `event` 7.5, 25.3 and 63.0.
"""

from __future__ import annotations

import numpy as np
import pytest

from oracle.event_world import event_world
from oracle.layout import gas, settled
from oracle.predictability import horizon

COUNT = 32
SEEDS = range(10)
KNOWN = {0.05: 7.7, 0.3: 27.3, 0.6: 63.5}


def position_of_oracle(start, bits):
    oracle = start.oracle(bits)

    def at(time):
        oracle.run_to(time)
        return oracle.position.astype(float)

    return at


def position_of_event(start, tick_rate):
    world = event_world(start, tick_rate)

    def at(time):
        world.run(round(time * tick_rate) - world.tick)
        return world.position

    return at


@pytest.mark.parametrize(("packing", "tick_rate"), [(0.05, 2), (0.3, 16), (0.6, 32)])
def test_horizon_of_event_is_that_of_53_bits(packing, tick_rate):
    starts = [settled(gas(seed, COUNT, packing), hits_per_disc=3) for seed in SEEDS]
    oracle = np.mean([horizon(start, 1 / tick_rate, position_of_oracle(start, 53)) for start in starts])
    event = np.mean([horizon(start, 1 / tick_rate, position_of_event(start, tick_rate)) for start in starts])
    assert oracle == pytest.approx(KNOWN[packing], rel=0.05)
    assert event == pytest.approx(oracle, rel=0.2)


def test_horizon_grows_with_the_bits():
    # Each bit buys the same number of collisions: the sign of exponential growth, and that the oracle is
    # limited by bits.
    start = settled(gas(0, COUNT, 0.3), hits_per_disc=3)
    few, double, more = (horizon(start, 1 / 16, position_of_oracle(start, bits)) for bits in (32, 53, 74))
    assert few < double < more
    assert more - double == pytest.approx(double - few, rel=0.5)
