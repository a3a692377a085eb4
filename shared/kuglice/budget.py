"""How much work a tick of a game may be: for those who step in real time, and would rather do without than wait."""

from __future__ import annotations

from kuglice.world import World

__all__ = ["tick_budget"]

PAIRS = 200_000
PAIRS_PER_BALL = 512
"""They take 20 ns and more each. A pile at rest, the dearest scene of ours, takes 500 a ball, a gas less than one."""


def tick_budget(world: World) -> int:
    """Pairs that the next tick of `world` may look at (`World.step`)."""
    return PAIRS + PAIRS_PER_BALL * world.count
