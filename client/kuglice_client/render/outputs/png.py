"""Frames as PNG files."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from kuglice.errors import PictureError
from kuglice.extras import extra
from kuglice.picture import encode_png
from kuglice_client.render.outputs.output import Encoder

__all__ = ["LastPicture", "PictureFolder", "PictureSequence", "open_png"]

Pixels = NDArray[np.uint8]

PATTERN = re.compile(r"%(0\d+)?d")


def open_png(path: Path, size: tuple[int, int], fps: float) -> Encoder:
    """A sequence if the name has a number pattern (`%d`, `%05d`), otherwise the last frame alone."""
    if "%" not in path.name:
        return LastPicture(path)
    if len(PATTERN.findall(path.name)) != 1 or path.name.count("%") != 1:
        raise PictureError(f"output {path}: its name needs one number pattern like %05d")
    return PictureSequence(path)


class PictureSequence:
    """One file per frame."""

    def __init__(self, path: Path) -> None:
        with extra("render"):
            import PIL  # noqa: F401, PLC0415 - an extra; told now rather than at the first frame
        self._path = path

    def write(self, pixels: Pixels, number: int) -> None:
        """Write the file of this frame."""
        self._path.with_name(self._path.name % number).write_bytes(encode_png(pixels))

    def close(self) -> None:
        """Nothing is left to do."""


class PictureFolder(PictureSequence):
    """A directory with one file per frame."""

    def __init__(self, path: Path, size: tuple[int, int], fps: float) -> None:
        path.mkdir(parents=True, exist_ok=True)
        super().__init__(path / "frame-%05d.png")


class LastPicture:
    """One file: the last frame."""

    def __init__(self, path: Path) -> None:
        with extra("render"):
            import PIL  # noqa: F401, PLC0415 - an extra; told now rather than at the end
        self._path = path
        self._last: Pixels | None = None

    def write(self, pixels: Pixels, number: int) -> None:
        """Remember this frame."""
        self._last = pixels

    def close(self) -> None:
        """Write the file, if there was a frame."""
        if self._last is not None:
            self._path.write_bytes(encode_png(self._last))
