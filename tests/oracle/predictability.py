"""How long a path can be followed: rounding errors grow by a factor per collision."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import gmpy2  # type: ignore[import-untyped]
import numpy as np
from gmpy2 import mpfr

from oracle.hard_discs import Oracle
from oracle.layout import Floats, Start

BITS = 160
NUDGE = 1e-25
"""Far above the rounding of 160 bits, far below that of 53."""


def nudged(start: Start) -> Oracle:
    """The same world, its moving balls displaced by about NUDGE radii."""
    away = NUDGE * np.random.default_rng(0).normal(size=start.position.shape)
    away[~np.isfinite(start.mass)] = 0.0
    with gmpy2.context(precision=BITS):
        position = [
            [mpfr(place) + mpfr(step) for place, step in zip(*pair, strict=True)]
            for pair in zip(start.position, away, strict=True)
        ]
    return Oracle(
        start.box if start.walls else None,
        position,
        start.velocity,
        start.radius,
        start.mass,
        gravity=start.gravity,
        restitution=start.restitution,
        bits=BITS,
    )


def window(start: Start, tick: float, bound: float = 1e-10) -> Iterator[tuple[float, Oracle, float]]:
    """(time, oracle at that time, predicted rounding) per tick, while the prediction is below `bound`.

    Predicted: the last bit of the largest coordinate, times the growth of a nudge so far.
    """
    oracle, other = start.oracle(BITS), nudged(start)
    rounding = 2.0**-53 * max(map(abs, start.box))
    time, grown = 0.0, rounding
    while grown < bound:
        yield time, oracle, grown
        time += tick
        oracle.run_to(time)
        other.run_to(time)
        grown = rounding * max(1.0, furthest(oracle, other) / NUDGE)


def furthest(one: Oracle, other: Oracle) -> float:
    """Largest distance of a ball in one from the same ball in the other, along an axis."""
    with gmpy2.context(precision=BITS):
        return float(np.abs(one.position - other.position).max())


def horizon(start: Start, tick: float, position_at: Callable[[float], Floats], error: float = 0.01) -> float:
    """Collisions per disc until the RMS error over discs passes `error`, interpolated in its logarithm."""
    oracle = start.oracle(BITS)
    time, before = 0.0, (0.0, 0.0)
    while True:
        time += tick
        oracle.run_to(time)
        apart = position_at(time) - oracle.position.astype(float)
        rms = float(np.sqrt((apart**2).sum() / start.moving))
        collisions = 2 * oracle.collisions / start.moving
        if rms > error:
            share = np.log(error / before[0]) / np.log(rms / before[0]) if before[0] > 0 else 1.0
            return float(before[1] + share * (collisions - before[1]))
        before = (rms, collisions)
