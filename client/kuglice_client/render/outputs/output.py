"""Output: frames go in, a thread of its own encodes them."""

from __future__ import annotations

import queue
import threading
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from kuglice.closing import Closing
from kuglice.errors import PictureError

__all__ = ["Encoder", "Output"]

Pixels = NDArray[np.uint8]


class Encoder(Protocol):
    """Writes frames of one size to a file. Called from one thread only."""

    def write(self, pixels: Pixels, number: int) -> None:
        """Frame `number`, counted from 0; ascending, but some may be left out."""

    def close(self) -> None:
        """Finish the file."""


class Output(Closing):
    """A film or pictures being written. A context manager; leaving it finishes the file.

    What goes wrong in the thread is raised by the next `write` or by `close`, as PictureError.
    """

    def __init__(self, path: Path, size: tuple[int, int], encoder: Encoder, depth: int) -> None:
        self.path = path
        self.frames = 0
        """Frames written, those that wait included."""
        self.dropped = 0
        """Frames that `write(wait=False)` found no room for."""
        self._size = size
        self._encoder = encoder
        self._queue: queue.Queue[tuple[Pixels, int] | None] = queue.Queue(maxsize=max(1, depth))
        self._error: BaseException | None = None
        self._closed = False
        self._thread = threading.Thread(target=self._encode, name=f"encode {path.name}", daemon=True)
        self._thread.start()

    @property
    def behind(self) -> int:
        """Frames that wait to be encoded."""
        return self._queue.qsize()

    def write(self, pixels: Pixels, *, wait: bool = True) -> bool:
        """Add a copy of a frame (height, width, 3).

        When too many frames wait already: wait, or, told not to, leave this one out and return False; the
        film then shows the one before for longer, so that it keeps its time.
        """
        self._check()
        if self._closed:
            raise PictureError(f"output {self.path}: is closed, no frame can be added")
        width, height = self._size
        if pixels.shape != (height, width, 3) or pixels.dtype != np.uint8:
            got = f"{pixels.shape} of {pixels.dtype}"
            raise PictureError(
                f"output {self.path}: a frame ({height}, {width}, 3) of uint8 is needed, got {got}"
            )
        number = self.frames + self.dropped
        if not wait and self._queue.full():
            self.dropped += 1
            return False
        self._queue.put((pixels.copy(), number))
        self.frames += 1
        return True

    def close(self) -> None:
        """Encode what waits and finish the file. Calling it again does nothing."""
        if self._closed:
            return
        self._closed = True
        self._queue.put(None)
        self._thread.join()
        self._check()

    def _check(self) -> None:
        if self._error is not None:
            why = self._error.strerror if isinstance(self._error, OSError) else None
            raise PictureError(f"output {self.path}: {why or self._error}") from self._error

    def _encode(self) -> None:
        try:
            while (item := self._queue.get()) is not None:
                self._encoder.write(*item)
        except Exception as error:  # the thread has nobody above it: whoever calls next is told
            self._error = error
            self._drain()
        try:
            self._encoder.close()
        except Exception as error:
            self._error = self._error or error

    def _drain(self) -> None:
        """Keep `write` from waiting for ever, until `close`."""
        while self._queue.get() is not None:
            pass
