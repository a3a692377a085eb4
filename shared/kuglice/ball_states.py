"""Some balls of a world, by id: what is known of them, and when nothing is known of the others."""

from __future__ import annotations

from typing import NamedTuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kuglice.errors import SceneError

__all__ = ["BallStates", "ids"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


class _Arrays(TypedDict):
    id: Ids
    position: Floats
    velocity: Floats
    radius: Floats
    mass: Floats


class BallStates(NamedTuple):
    """Ids (n,), ascending; position and velocity (n, 2); radius and mass (n,), an infinite mass is a peg."""

    id: ArrayLike
    position: ArrayLike
    velocity: ArrayLike
    radius: ArrayLike
    mass: ArrayLike

    @classmethod
    def none(cls) -> BallStates:
        """Of no balls."""
        return cls((), (), (), (), ())

    def arrays(self) -> _Arrays:
        """As the compiled core wants them. Raises SceneError for ids that are none, and for other numbers."""
        numbered = ids("id", self.id)
        try:
            return {
                "id": numbered,
                "position": np.asarray(self.position, np.float64).reshape(-1, 2),
                "velocity": np.asarray(self.velocity, np.float64).reshape(-1, 2),
                "radius": np.asarray(self.radius, np.float64).reshape(-1),
                "mass": np.asarray(self.mass, np.float64).reshape(-1),
            }
        except (ValueError, TypeError) as error:
            raise SceneError(f"states of balls: {error}") from error


def ids(name: str, given: ArrayLike) -> Ids:
    """(n,) uint64. A number below 0 would become a large one without a word: raises SceneError."""
    array = np.asarray(given)
    if array.size == 0:
        return np.empty(0, np.uint64)
    if array.ndim != 1 or array.dtype.kind not in "iu" or array.min() < 0:
        raise SceneError(f"{name} {str(given)[:80]}: must be a row of whole numbers, 0 or above")
    return array.astype(np.uint64, copy=False)
