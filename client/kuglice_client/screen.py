"""What a person at the screen sees: how the picture goes from one prediction to another, and what is seen of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice_client.correction import LIMIT_RADII, SECONDS, Correction
from kuglice_client.feel import Feel
from kuglice_client.prediction import Drawn, Prediction

__all__ = ["Screen"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


class Screen:
    """Counts what is seen, `correction` and `feel`, and moves nothing but the picture.

    `seconds`, `limit`: of Correction.
    """

    def __init__(self, *, seconds: float = SECONDS, limit: float = LIMIT_RADII) -> None:
        self.correction = Correction(seconds=seconds, limit=limit)
        self.feel = Feel()
        self.alpha = 0.0
        self._frame_at: float | None = None

    def entered(self) -> None:
        """Another run of the server: nothing of the last one is seen any more."""
        self.correction.clear()
        self.feel.entered()
        self._frame_at = None

    def frame(self, now: float, prediction: Prediction) -> None:
        """A frame is drawn, `now` in seconds."""
        world = prediction.shown[1]
        self.correction.frame(now, world.count)
        self.feel.shown(world.tick, now)
        self._frame_at = now

    def switched(self, before: Drawn, prediction: Prediction, *, now: float, rate: float) -> None:
        """From now on the prediction is drawn instead of `before`: that jump is glided over, and counted.

        If it is ahead, what the balls do in the ticks that have passed since the last frame, of `rate` per second,
        is motion and no jump; more than that would not have been seen.
        """
        if self._frame_at is None:
            return
        previous, world = before
        ids, position = prediction.blended(previous, world, self.alpha)
        after = prediction.world
        ahead = min(after.tick - world.tick, (now - self._frame_at) * rate)
        if ahead > 0:
            position = position + world.velocity * (ahead / world.scene.tick_rate)
        self.correction.moved(ids, position, *prediction.drawn(self.alpha), prediction.shown[1].radius)

    def seen(self, ids: Ids, position: Floats) -> Floats:
        """`position` (n, 2) of the balls `ids`, which ascend, where they are drawn."""
        return self.correction.drawn(ids, position)
