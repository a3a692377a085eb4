"""What stays the same from frame to frame, and the signature of everything that draws on one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kuglice.picture import Camera
from kuglice.scene import Scene
from kuglice_client.render.moment import Moment

__all__ = ["Layer", "Pixels", "Stage"]

Pixels = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Stage:
    """The scene, how it is seen, the speed that gets the last colour, and the client that looks (or None)."""

    scene: Scene
    camera: Camera
    reference: float
    own: int | None = None


Layer = Callable[[Pixels, Stage, Moment], None]
"""Draws a moment onto a picture (height, width, 3), in place. Every style and every overlay is one."""
