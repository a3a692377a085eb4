"""What runs a scene: a world of this package or a peer, looked at through the same few names."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from kuglice.model import Model
from kuglice.scene import Scene
from kuglice.world import World

__all__ = ["CannotRunError", "Make", "Running", "making"]


class CannotRunError(Exception):
    """A method that cannot run a scene; the reason is printed beside the chart that it is missing from."""


class Running(Protocol):
    """A scene in motion."""

    def run(self, ticks: int) -> None:
        """That many ticks of 1 / scene.tick_rate."""

    @property
    def position(self) -> NDArray[np.float64]:
        """(n, 2), in the order of the scene's balls."""

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n, 2)."""

    @property
    def collisions(self) -> int:
        """Pairs that met since the start."""


Make = Callable[[Scene], Running]


def making(model: Model) -> Make:
    """Worlds of one model."""
    return lambda scene: World(scene, model)
