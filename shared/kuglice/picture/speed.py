"""The colour of a ball: how fast it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kuglice.picture.oklab import ramp

if TYPE_CHECKING:
    from kuglice.scene import Scene

__all__ = ["PEG", "SPEED_PALETTE", "reference_speed", "speed_colours", "speed_values"]

Floats = NDArray[np.float64]
Pixels = NDArray[np.uint8]

SPEED_PALETTE: Pixels = ramp(
    [
        (0.47, 0.12, 265),
        (0.55, 0.19, 290),
        (0.64, 0.22, 350),
        (0.73, 0.18, 40),
        (0.86, 0.15, 85),
        (0.96, 0.07, 100),
    ]
)
"""(256, 3) from slow, a dark blue, to fast, a pale yellow: ever lighter, so it reads without colour too."""

PEG: Pixels = np.array([104, 114, 130], dtype=np.uint8)
"""Balls that nothing moves."""


def reference_speed(scene: Scene) -> float:
    """The speed that gets the last colour. It depends on the scene alone, so all pictures of a scene agree.

    v^2 = (2 rms)^2 + g h: in equilibrium all but e^-4 = 2 % of the balls stay below twice the root mean
    square of the speeds, here those at the start, and sqrt(g h) is what a fall through half of the box adds;
    where players steer, an eighth of the box at full thrust counts like a fall. Where one ball is much faster
    than that, the geometric mean of both, so that it and what it hits can be told apart; where nothing moves
    and nothing falls, a tenth of the box's diagonal per second.
    """
    left, bottom, right, top = scene.box
    moving = scene.balls.velocity[np.isfinite(scene.balls.mass)]
    square = 4 * float(np.square(moving).sum()) / max(1, len(moving))
    for force in scene.forces:
        if force.kind == "gravity":
            square += abs(force.x) * (right - left) + abs(force.y) * (top - bottom)
    if scene.players is not None and scene.limits.thrust:
        square += scene.limits.thrust / scene.players.mass * min(right - left, top - bottom) / 4
    speed = float(np.sqrt(square))
    if not speed:
        return float(np.hypot(right - left, top - bottom)) / 10
    fastest = float(np.hypot(*moving.T).max(initial=0.0))
    return max(speed, float(np.sqrt(speed * fastest)))


def speed_values(velocity: Floats, reference: float) -> Floats:
    """(n, 2) velocities -> (n,) within 0 and 1, 1 at the reference speed and above."""
    return np.minimum(np.hypot(velocity[:, 0], velocity[:, 1]) / reference, 1.0)


def speed_colours(velocity: Floats, reference: float, fixed: NDArray[np.bool_] | None = None) -> Pixels:
    """(n, 2) velocities -> (n, 4) red, green, blue, opacity. Balls marked in `fixed` are pegs."""
    colours = np.full((len(velocity), 4), 255, dtype=np.uint8)
    last = len(SPEED_PALETTE) - 1
    colours[:, :3] = SPEED_PALETTE[np.rint(last * speed_values(velocity, reference)).astype(np.intp)]
    if fixed is not None:
        colours[fixed, :3] = PEG
    return colours
