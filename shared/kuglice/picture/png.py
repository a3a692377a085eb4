"""Pictures as PNG."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra
from kuglice.picture.balls import draw
from kuglice.picture.speed import reference_speed

if TYPE_CHECKING:
    from kuglice.world import World

__all__ = ["encode_png", "png"]


def png(world: World, size: tuple[int, int] | None = None) -> bytes:
    """A world as it is now: what a notebook shows. Raises MissingExtraError without Pillow."""
    scene = world.scene
    return encode_png(
        draw(
            world.position,
            world.velocity,
            world.radius,
            box=scene.box,
            size=size,
            reference=reference_speed(scene),
            fixed=np.isinf(world.mass),
            walls=scene.walls,
        )
    )


def encode_png(pixels: NDArray[np.uint8]) -> bytes:
    """(height, width, 3) bytes -> a PNG file. Raises MissingExtraError without Pillow."""
    with extra("render"):
        from PIL import Image  # noqa: PLC0415 - an extra
    file = io.BytesIO()
    # The default effort takes three times as long for a few per cent fewer bytes.
    Image.fromarray(pixels).save(file, "PNG", compress_level=3)
    return file.getvalue()
