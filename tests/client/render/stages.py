"""A small scene, and moments of it made from arrays."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import kuglice as kg
from kuglice_client.render import Moment

BOX = (0.0, 0.0, 20.0, 10.0)
SIZE = (320, 180)


def scene(**more: Any) -> kg.Scene:
    """Two balls that move apart, at 60 ticks per second."""
    balls = kg.Balls(
        position=np.array([[5.0, 5.0], [15.0, 5.0]]),
        velocity=np.array([[-1.0, 0.0], [1.0, 0.0]]),
        radius=np.array([1.0, 1.0]),
    )
    return kg.Scene(box=BOX, balls=balls, **more)


def moment(*positions: tuple[float, float], ids: tuple[int, ...] | None = None, **more: Any) -> Moment:
    """Balls of radius 1 at rest."""
    count = len(positions)
    return Moment(
        position=np.array(positions, dtype=np.float64).reshape(-1, 2),
        velocity=np.zeros((count, 2)),
        radius=np.ones(count),
        id=np.array(range(count) if ids is None else ids, dtype=np.uint64),
        **more,
    )


def read(path: Path) -> NDArray[np.uint8]:
    """A picture (height, width, 3)."""
    with Image.open(path) as image:
        return np.asarray(image)
