"""How long a metre is in the picture, and which part of the world it shows."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from kuglice import _core
from kuglice_client.render.moment import Moment
from kuglice_client.render.stage import Pixels, Stage
from kuglice_client.render.text import Font

__all__ = ["draw_scale", "round_length"]

PANEL = (7, 9, 13, 205)
LINE = (226, 232, 243, 255)
TEXT = (226, 232, 243)
FAINT = (140, 152, 174)
SHARE = 0.15
"""Of the picture's width that the line takes at most."""


@cache
def _font(size: int) -> Font:
    return Font(size)


def round_length(most: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is at most `most` > 0."""
    power = 10.0 ** math.floor(math.log10(most))
    return max((factor * power for factor in (1, 2, 5) if factor * power <= most), default=power)


def draw_scale(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """A line of so many metres, and the corners of what is seen, in a dark pill at the bottom left. Needs a font."""
    height = pixels.shape[0]
    font = _font(max(9, min(28, round(height / 45))))
    box = stage.scene.box
    left, bottom, right, top = box if moment.window is None else moment.window.rectangle
    pixels_per_metre = stage.camera.scale * (box[2] - box[0]) / (right - left)
    metres = round_length(SHARE * (right - left))
    line = metres * pixels_per_metre
    decimals = max(0, 1 - math.floor(math.log10(metres)))
    x0, x1, y0, y1 = (f"{round(side, decimals):.12g}" for side in (left, right, bottom, top))
    words = [(f"{metres:g} m", TEXT), (f"x {x0} to {x1}, y {y0} to {y1}", FAINT)]
    gap, thick = 1.1 * font.size, 2.0 * font.size
    window = stage.camera.window()
    x, y = window[0] + 0.5 * font.size + thick / 2, window[3] - 0.5 * font.size - thick / 2
    length = line + sum(gap + font.length(word) for word, _ in words)
    _segment(pixels, (x, y), (x + length, y), thick, PANEL)
    tick = 0.3 * font.size
    for start, end in (
        ((x, y), (x + line, y)),
        ((x, y - tick), (x, y + tick)),
        ((x + line, y - tick), (x + line, y + tick)),
    ):
        _segment(pixels, start, end, max(1.0, font.size / 8), LINE)
    x += line
    for word, ink in words:
        x += gap
        font.draw(pixels, x, y, word, ink)
        x += font.length(word)


def _segment(
    pixels: Pixels,
    start: tuple[float, float],
    end: tuple[float, float],
    thickness: float,
    colour: tuple[int, int, int, int],
) -> None:
    ends = np.array([start]), np.array([end])
    _core.draw_segments(pixels, *ends, np.array([thickness]), np.array([colour], dtype=np.uint8))
