"""What a desync looked like: the first tick, the balls that differ, and their bits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kuglice import World

__all__ = ["Desync", "compare_worlds"]

SHOWN_BALLS = 8


@dataclass(frozen=True)
class Desync:
    """`tick`: the state that differed first, as far as seen. `balls`: lines for some of those that differ."""

    tick: int
    found_by: str
    differing: int
    balls: tuple[str, ...]

    def __str__(self) -> str:
        lines = "".join(f"\n  {line}" for line in self.balls)
        return (
            f"desync at state {self.tick}, found by its {self.found_by}: {self.differing} balls differ{lines}"
        )


def compare_worlds(ours: World, theirs: World, *, found_by: str) -> Desync:
    """Two states of one tick, ball by ball, bit by bit."""
    our_rows, their_rows = _rows(ours), _rows(theirs)
    ids = sorted(our_rows.keys() | their_rows.keys())
    differing = [ball for ball in ids if our_rows.get(ball) != their_rows.get(ball)]
    lines = tuple(
        f"ball {ball}: here {our_rows.get(ball, 'missing')}, there {their_rows.get(ball, 'missing')}"
        for ball in differing[:SHOWN_BALLS]
    )
    return Desync(ours.tick, found_by, len(differing), lines)


def _rows(world: World) -> dict[int, str]:
    numbers = np.column_stack([world.position, world.velocity, world.radius, world.mass])
    return {
        int(ball): " ".join(value.hex() for value in row)
        for ball, row in zip(world.id, numbers.tolist(), strict=True)
    }
