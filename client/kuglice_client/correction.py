"""What the eye sees of a rollback: balls glide to where they should be, while the state is right at once.

A ball that a correction moved keeps, on screen, the place where it was drawn, and loses that offset
exponentially, to a third in `seconds`. One that was moved further than `limit` radii is put right at once:
gliding across half the scene looks worse than a jump.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from kuglice.errors import LimitError

__all__ = ["LIMIT_RADII", "SECONDS", "Correction"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]

SECONDS = 0.1
LIMIT_RADII = 8.0
INVISIBLE_RADII = 1e-3


class Correction:
    """Offsets from the state to the picture, per ball.

    `mean` and `worst` are in radii, over all balls and frames. A ball counts in a frame with the length of
    its offset, or of the jump if it was put right at once. `worst_jump`: of a state, before any gliding.
    Raises LimitError for a time or a limit that is not above 0.
    """

    def __init__(self, *, seconds: float = SECONDS, limit: float = LIMIT_RADII) -> None:
        for name, value in (("seconds", seconds), ("limit", limit)):
            if not value > 0:
                raise LimitError(f"correction: {name} = {value}: must be greater than 0")
        self._seconds = seconds
        self._limit = limit
        self._id: Ids = np.empty(0, np.uint64)
        self._offset: Floats = np.empty((0, 2))
        self._radius: Floats = np.empty(0)
        self._at: float | None = None
        self._snapped = 0.0
        self._sum = 0.0
        self._balls = 0
        self.worst = 0.0
        self.worst_jump = 0.0
        self.snaps = 0

    @property
    def mean(self) -> float:
        """Mean visible correction of a ball in a frame, in radii."""
        return self._sum / self._balls if self._balls else 0.0

    @property
    def now(self) -> float:
        """Largest offset at present, in radii."""
        return float(self._lengths().max(initial=0.0))

    def moved(self, before_id: Ids, before: Floats, now_id: Ids, now: Floats, radius: Floats) -> None:
        """Balls drawn at `before` (n, 2) would be drawn at `now` (m, 2) from here on. Ids ascend."""
        if not np.array_equal(before_id, now_id):
            _, was, here = np.intersect1d(before_id, now_id, assume_unique=True, return_indices=True)
            before, now_id, now, radius = before[was], now_id[here], now[here], radius[here]
        jump = before - now
        changed = (jump != 0.0).any(axis=1)
        if not changed.any():
            return
        jump, moved, radii = jump[changed], now_id[changed], radius[changed]
        self.worst_jump = max(self.worst_jump, float((np.hypot(jump[:, 0], jump[:, 1]) / radii).max()))
        ids = np.union1d(self._id, moved)
        offset = np.zeros((len(ids), 2))
        offset[np.searchsorted(ids, self._id)] = self._offset
        offset[np.searchsorted(ids, moved)] += jump
        _, kept, at = np.intersect1d(ids, now_id, assume_unique=True, return_indices=True)
        self._id, self._offset, self._radius = ids[kept], offset[kept], radius[at]
        lengths = self._lengths()
        far = ~(lengths <= self._limit)
        if far.any():
            self.snaps += int(far.sum())
            self._snapped += float(lengths[far].sum())
            self.worst = max(self.worst, float(lengths[far].max()))
            self._keep(~far)

    def frame(self, now: float, balls: int) -> None:
        """A frame of that many balls is drawn `now`, in seconds: offsets decay by the time that passed."""
        if self._at is not None and len(self._id):
            self._offset *= math.exp(-max(0.0, now - self._at) / self._seconds)
            self._keep(self._lengths() > INVISIBLE_RADII)
        self._at = now
        lengths = self._lengths()
        self._sum += float(lengths.sum()) + self._snapped
        self._snapped = 0.0
        self._balls += balls
        self.worst = max(self.worst, float(lengths.max(initial=0.0)))

    def drawn(self, ids: Ids, position: Floats) -> Floats:
        """`position` (n, 2) of the balls `ids`, which ascend, as the eye is to see them."""
        if not len(self._id):
            return position
        _, here, there = np.intersect1d(ids, self._id, assume_unique=True, return_indices=True)
        seen = position.copy()
        seen[here] += self._offset[there]
        return seen

    def clear(self) -> None:
        """Another world: nothing of the last one glides on."""
        self._keep(np.zeros(len(self._id), np.bool_))

    def _lengths(self) -> Floats:
        lengths: Floats = np.hypot(self._offset[:, 0], self._offset[:, 1]) / self._radius
        return lengths

    def _keep(self, which: NDArray[np.bool_]) -> None:
        self._id, self._offset, self._radius = self._id[which], self._offset[which], self._radius[which]
