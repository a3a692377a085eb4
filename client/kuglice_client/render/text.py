"""Text on pictures: glyphs drawn once by Pillow, then blended as they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra

__all__ = ["Font"]

SAME_WIDTH = "0123456789abcdef"


class Font:
    """Pillow's own font at a height in pixels. Digits are equally wide, so that counters do not jitter.

    Raises MissingExtraError without Pillow.
    """

    def __init__(self, size: int) -> None:
        with extra("render"):
            from PIL import ImageFont  # noqa: PLC0415 - an extra
        self.size = size
        self._font = ImageFont.load_default(size)
        self._cell = max(self._font.getlength(digit) for digit in SAME_WIDTH)
        # Digits are as high as capitals: half of that below the line is the middle of a line of text.
        box = self._font.getbbox("0", anchor="ls")
        self._rise = -box[1] / 2
        self._glyphs: dict[str, tuple[NDArray[np.float32], int, int]] = {}

    def _advance(self, letter: str) -> float:
        return self._cell if letter in "0123456789 " else float(self._font.getlength(letter))

    def length(self, text: str) -> float:
        """Pixels from the start to the end of a text."""
        return sum(self._advance(letter) for letter in text)

    def draw(
        self, pixels: NDArray[np.uint8], x: float, middle: float, text: str, colour: tuple[int, int, int]
    ) -> None:
        """Blend a text that starts at x and whose digits are centred on `middle`; clipped to the picture."""
        base = round(middle + self._rise)
        for letter in text:
            advance = self._advance(letter)
            if letter != " ":
                inside = (advance - self._font.getlength(letter)) / 2
                self._blend(pixels, round(x + inside), base, letter, colour)
            x += advance

    def _blend(
        self, pixels: NDArray[np.uint8], x: int, base: int, letter: str, colour: tuple[int, int, int]
    ) -> None:
        coverage, left, top = self._glyph(letter)
        x, y = x + left, base + top
        height, width = coverage.shape
        above, before = max(0, -y), max(0, -x)
        part = pixels[max(0, y) : max(0, y + height), max(0, x) : max(0, x + width)]
        if part.size:
            weight = coverage[above : above + part.shape[0], before : before + part.shape[1], None]
            part[:] = np.rint(part + (np.array(colour, dtype=np.float32) - part) * weight)

    def _glyph(self, letter: str) -> tuple[NDArray[np.float32], int, int]:
        if letter not in self._glyphs:
            from PIL import Image, ImageDraw  # noqa: PLC0415 - an extra

            left, top, right, bottom = (round(side) for side in self._font.getbbox(letter, anchor="ls"))
            image = Image.new("L", (max(1, right - left), max(1, bottom - top)))
            ImageDraw.Draw(image).text((-left, -top), letter, fill=255, font=self._font, anchor="ls")
            self._glyphs[letter] = (np.asarray(image, dtype=np.float32) / 255.0, left, top)
        return self._glyphs[letter]
