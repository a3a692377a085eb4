"""Animated GIF, with the best 256 colours of every frame."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra

__all__ = ["Gif"]

Pixels = NDArray[np.uint8]

CENTISECOND = Fraction(1, 100)
"""Delays in a GIF are whole numbers of these."""


class Gif:
    """One frame after the other goes through a palette of its own, so that nothing is kept in memory."""

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
        self._graph = Graph()
        source = self._graph.add_buffer(
            width=size[0], height=size[1], format=av.VideoFormat("rgb24"), time_base=CENTISECOND
        )
        split = self._graph.add("split")
        generate = self._graph.add("palettegen", "stats_mode=single:reserve_transparent=0")
        use = self._graph.add("paletteuse", "new=1:dither=bayer:bayer_scale=4:diff_mode=rectangle")
        sink = self._graph.add("buffersink")
        source.link_to(split)
        split.link_to(generate, 0, 0)
        split.link_to(use, 1, 0)
        generate.link_to(use, 0, 1)
        use.link_to(sink)
        self._graph.configure()

    def write(self, pixels: Pixels, number: int) -> None:
        """Reduce a frame to its palette and write it."""
        import av  # noqa: PLC0415 - an extra

        frame = av.VideoFrame.from_ndarray(pixels, format="rgb24")
        frame.pts = round(number / self._rate / CENTISECOND)
        frame.time_base = CENTISECOND
        self._graph.push(frame)
        self._pull()

    def _pull(self) -> None:
        import av  # noqa: PLC0415 - an extra
        from av.error import BlockingIOError as NothingYet  # noqa: PLC0415 - an extra
        from av.error import EOFError as End  # noqa: PLC0415 - an extra

        while True:
            try:
                frame = self._graph.pull()
            except (NothingYet, End):
                return
            assert isinstance(frame, av.VideoFrame), "nothing else goes in"
            self._container.mux(self._stream.encode(frame))

    def close(self) -> None:
        """Write what the filters hold, and close the file."""
        try:
            self._graph.push(None)
            self._pull()
            self._container.mux(self._stream.encode(None))
        finally:
            self._container.close()
