"""Colours by how they look: OKLab, in which equal distances look about equally different.

Source: B. Ottosson, A perceptual color space for image processing, 2020.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["from_srgb", "ramp", "to_srgb"]

Floats = NDArray[np.float64]

TO_CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def from_srgb(colour: NDArray[np.uint8]) -> Floats:
    """(n, 3) bytes -> (n, 3) lightness, green-red, blue-yellow."""
    part = np.asarray(colour) / 255.0
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    return np.asarray(np.cbrt(linear @ TO_CONES.T) @ TO_LAB.T)


def to_srgb(lab: Floats) -> NDArray[np.uint8]:
    """(n, 3) lightness, green-red, blue-yellow -> (n, 3) bytes; what no screen shows is cut off."""
    cones = (np.asarray(lab) @ np.linalg.inv(TO_LAB).T) ** 3
    linear = np.clip(cones @ np.linalg.inv(TO_CONES).T, 0.0, 1.0)
    part = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(255.0 * part), dtype=np.uint8)


def ramp(anchors: Sequence[tuple[float, float, float]], steps: int = 256) -> NDArray[np.uint8]:
    """(steps, 3) bytes through anchors of (lightness, chroma, hue in degrees), in even perceived steps."""
    lightness, chroma, hue = np.array(anchors).T
    angle = np.radians(hue)
    lab = np.stack([lightness, chroma * np.cos(angle), chroma * np.sin(angle)], axis=1)
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(lab, axis=0), axis=1))])
    at = np.linspace(0.0, way[-1], steps)
    return to_srgb(np.stack([np.interp(at, way, channel) for channel in lab.T], axis=1))
