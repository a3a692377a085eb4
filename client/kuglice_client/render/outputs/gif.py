"""Animated GIF."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra

if TYPE_CHECKING:
    from av import VideoFrame

__all__ = ["Gif"]

Pixels = NDArray[np.uint8]

CENTISECOND = Fraction(1, 100)
"""Delays in a GIF are whole numbers of these."""

KEPT = 100
"""Centiseconds for which a palette is kept: choosing one takes longer than all the rest."""


class Gif:
    """Every second takes the best 256 colours of its first frame."""

    def __init__(self, path: Path, size: tuple[int, int], fps: float) -> None:
        with extra("render"):
            import av  # noqa: PLC0415 - an extra
            from av.filter import Graph  # noqa: PLC0415 - an extra
        self._rate = Fraction(fps).limit_denominator(1001)
        self._container = av.open(str(path), "w", format="gif", options={"loop": "0"})
        self._stream = self._container.add_stream("gif", rate=100)
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = "pal8"
        self._stream.time_base = CENTISECOND
        self._palette: VideoFrame | None = None
        self._expires = 0

        width, height = size
        colours = av.VideoFormat("rgb24")
        self._choose = Graph()
        self._choose.link_nodes(
            self._choose.add_buffer(width=width, height=height, format=colours, time_base=CENTISECOND),
            self._choose.add("palettegen", "stats_mode=single:reserve_transparent=1"),
            self._choose.add("buffersink"),
        ).configure()
        self._apply = Graph()
        self._pictures = self._apply.add_buffer(
            width=width, height=height, format=colours, time_base=CENTISECOND
        )
        self._palettes = self._apply.add_buffer(
            width=16, height=16, format=av.VideoFormat("rgb32"), time_base=CENTISECOND
        )
        use = self._apply.add("paletteuse", "new=1:dither=none")
        self._pictures.link_to(use, 0, 0)
        self._palettes.link_to(use, 0, 1)
        use.link_to(self._apply.add("buffersink"))
        self._apply.configure()

    def write(self, pixels: Pixels, number: int) -> None:
        """Reduce a frame to its palette and write what changed."""
        import av  # noqa: PLC0415 - an extra

        frame = av.VideoFrame.from_ndarray(pixels, format="rgb24")
        frame.pts = round(number / self._rate / CENTISECOND)
        frame.time_base = CENTISECOND
        palette = self._palette
        if palette is None or frame.pts >= self._expires:
            self._choose.vpush(frame)
            palette = self._palette = self._choose.vpull()
            self._expires = frame.pts + KEPT
        palette.pts, palette.time_base = frame.pts, CENTISECOND
        self._pictures.push(frame)
        self._palettes.push(palette)
        self._pull()

    def _pull(self) -> None:
        from av.error import BlockingIOError as NothingYet  # noqa: PLC0415 - an extra
        from av.error import EOFError as End  # noqa: PLC0415 - an extra

        while True:
            try:
                frame = self._apply.vpull()
            except (NothingYet, End):
                return
            frame.time_base = CENTISECOND
            self._container.mux(self._stream.encode(frame))

    def close(self) -> None:
        """Write what the filters hold, and close the file."""
        try:
            self._pictures.push(None)
            self._palettes.push(None)
            self._pull()
            self._container.mux(self._stream.encode(None))
        finally:
            self._container.close()
