"""Films: H.264 in MP4, VP9 in WebM, both by PyAV, whose wheels bring the codecs."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra

__all__ = ["Mp4", "WebM"]

Pixels = NDArray[np.uint8]

BT709 = 1
LIMITED = 1
"""Numbers of the H.273 standard, by which a player turns the film back into the same colours."""


class Video:
    """A film by one codec; both sides of `size` are even."""

    codec: ClassVar[str]
    options: ClassVar[dict[str, str]]
    container: ClassVar[dict[str, str]] = {}

    def __init__(self, path: Path, size: tuple[int, int], fps: float) -> None:
        with extra("render"):
            import av  # noqa: PLC0415 - an extra
        rate = Fraction(fps).limit_denominator(1001)
        self._container = av.open(str(path), "w", options=self.container)
        stream = self._container.add_stream(self.codec, rate=rate, options=self.options)
        assert isinstance(stream, av.VideoStream), "both codecs are of video"
        self._stream = stream
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = "yuv420p"
        # The muxer gives the stream another one as soon as it writes the header; frames keep theirs.
        self._time_base = 1 / rate
        self._stream.time_base = self._time_base
        context = self._stream.codec_context
        context.colorspace = context.color_primaries = context.color_trc = BT709
        context.color_range = LIMITED

    def write(self, pixels: Pixels, number: int) -> None:
        """Encode a frame; what the codec has finished goes to the file."""
        import av  # noqa: PLC0415 - an extra

        frame = av.VideoFrame.from_ndarray(pixels, format="rgb24")
        frame = frame.reformat(format="yuv420p", dst_colorspace=BT709, dst_color_range=LIMITED)
        frame.pts = number
        frame.time_base = self._time_base
        self._container.mux(self._stream.encode(frame))

    def close(self) -> None:
        """Let the codec finish what it holds, and close the file."""
        try:
            self._container.mux(self._stream.encode(None))
        finally:
            self._container.close()


class Mp4(Video):
    """Plays everywhere."""

    codec = "libx264"
    options: ClassVar[dict[str, str]] = {"preset": "veryfast", "crf": "19"}
    container: ClassVar[dict[str, str]] = {"movflags": "+faststart"}


class WebM(Video):
    """Free of patents."""

    codec = "libvpx-vp9"
    options: ClassVar[dict[str, str]] = {
        "deadline": "realtime",
        "cpu-used": "7",
        "row-mt": "1",
        "crf": "28",
        "b": "0",
    }
