"""Where frames go: one file per kind, the same signature, one table by suffix."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path

from kuglice.errors import PictureError
from kuglice_client.render.outputs.gif import Gif
from kuglice_client.render.outputs.output import Encoder, Output
from kuglice_client.render.outputs.png import PictureFolder, open_png
from kuglice_client.render.outputs.video import Mp4, WebM

__all__ = ["OUTPUTS", "Encoder", "Output", "check_output", "open_output"]

OUTPUTS: dict[str, Callable[[Path, tuple[int, int], float], Encoder]] = {
    ".mp4": Mp4,
    ".webm": WebM,
    ".gif": Gif,
    ".png": open_png,
    "": PictureFolder,
}
FILMS = (".mp4", ".webm")
"""Colour is stored for two by two pixels."""


def open_output(path: str | PathLike[str], *, size: tuple[int, int], fps: float, depth: int = 8) -> Output:
    """Open a film or pictures for frames of `size` (width, height), `fps` frames per second.

    The suffix says the kind: `.mp4`, `.webm`, `.gif`, or `.png`: with a pattern like `frame-%05d.png` one
    file per frame, counted from 0; without one, the last frame only. No suffix is a directory for one PNG per
    frame. Missing directories are made, an existing file is replaced. `depth` frames may wait for their
    encoding. Raises PictureError for what cannot be opened as asked, and MissingExtraError without the extra
    `render`.
    """
    target = Path(path)
    check_output(target, size=size, fps=fps)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        encoder = OUTPUTS[target.suffix.lower()](target, size, fps)
    except OSError as error:
        raise PictureError(f"output {target}: cannot be written: {error.strerror or error}") from error
    return Output(target, size, encoder, depth)


def check_output(path: Path, *, size: tuple[int, int], fps: float) -> None:
    """Raises PictureError for what `open_output` would not take, and touches nothing."""
    kind = path.suffix.lower()
    if kind not in OUTPUTS:
        kinds = ", ".join(suffix for suffix in OUTPUTS if suffix)
        raise PictureError(f"output {path}: must be a directory, or its suffix one of {kinds}")
    if not 0 < fps <= 1000:
        raise PictureError(f"output {path}: {fps} frames per second, must be above 0 and at most 1000")
    width, height = size
    if kind in FILMS and (width % 2 or height % 2):
        raise PictureError(f"output {path}: a film needs even numbers of pixels, got {width}x{height}")
