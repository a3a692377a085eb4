"""Which balls differ between two worlds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kuglice.world import World

__all__ = ["Difference", "difference"]

NAMED = 8


class Difference(NamedTuple):
    """Of two states at one tick."""

    tick: int
    balls: tuple[int, ...]
    """Ids of balls that differ in any bit, or that only one of the worlds has."""
    worst: float
    """Largest distance between the two positions of a ball, in its radii."""

    def __str__(self) -> str:
        if not self.balls:
            return f"at tick {self.tick} no ball differs, but counters, players or held inputs do"
        named = ", ".join(str(ball) for ball in self.balls[:NAMED])
        more = f" and {len(self.balls) - NAMED} more" if len(self.balls) > NAMED else ""
        noun = "ball" if len(self.balls) == 1 else "balls"
        differ = "differs" if len(self.balls) == 1 else "differ"
        return f"at tick {self.tick} {noun} {named}{more} {differ}, by up to {self.worst:.3g} radii"


def difference(expected: World, found: World) -> Difference:
    """Compare bit by bit; both worlds must be of one scene."""
    mine, yours = expected.id, found.id
    both, here, there = np.intersect1d(mine, yours, assume_unique=True, return_indices=True)
    unequal = np.zeros(len(both), dtype=bool)
    for name in ("position", "velocity", "radius", "mass"):
        first, second = getattr(expected, name)[here], getattr(found, name)[there]
        differs = _bits(first) != _bits(second)
        unequal |= differs.any(axis=1) if differs.ndim == 2 else differs
    apart = expected.position[here] - found.position[there]
    radii = np.sqrt(apart[:, 0] * apart[:, 0] + apart[:, 1] * apart[:, 1]) / expected.radius[here]
    only = np.setxor1d(mine, yours, assume_unique=True)
    balls = sorted(int(ball) for ball in np.concatenate([both[unequal], only]))
    return Difference(expected.tick, tuple(balls), float(radii.max()) if len(radii) else 0.0)


def _bits(array: NDArray[np.float64]) -> NDArray[np.uint64]:
    return np.ascontiguousarray(array).view(np.uint64)
