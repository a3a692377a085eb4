"""Sizes of pictures, as they are written on a command line."""

from __future__ import annotations

import re

from kuglice.errors import PictureError

__all__ = ["parse_size"]


def parse_size(text: str) -> tuple[int, int]:
    """ "1280x720" -> (1280, 720). Raises PictureError."""
    match = re.fullmatch(r"(\d{1,6})x(\d{1,6})", text.strip().lower())
    if match is None:
        raise PictureError(f"size {text!r}: must be two whole numbers of pixels like 1280x720")
    return int(match[1]), int(match[2])
