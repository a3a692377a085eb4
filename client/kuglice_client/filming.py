"""Rendering beside playing: moments go to a process of low priority that draws and encodes them.

Drawing 600 balls and encoding the frame costs as much as several hundred ticks of the step. In the client's
own process it would delay ticks, and on a machine that the server shares it would delay those too. So the
frames lag behind the play as much as they must, in a queue with a bound, and are finished after it.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import queue
import signal
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kuglice import Scene
from kuglice.errors import KugliceError
from kuglice.picture import encode_png
from kuglice_client.render import Renderer, check_look, check_output, open_output
from kuglice_client.render.moment import Moment

__all__ = ["Film", "FilmSettings"]

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.queues import Queue

    Moments = Queue[Moment | None]

WAITING_BYTES = 256 << 20
"""Moments that wait may hold this much; later ones are left out, and counted."""
BYTES_PER_BALL = 57
STEPS_ASIDE = 10


@dataclass(frozen=True)
class FilmSettings:
    """How it looks and where it goes. Raises PictureError for what can neither be drawn nor written.

    `still_every`: frames from one PNG beside the film to the next, 0 for none. `reference`: the speed that gets
    the last colour (None: taken from the scene).
    """

    path: Path
    fps: int = 30
    size: tuple[int, int] = (1280, 720)
    style: str = "discs"
    overlays: tuple[str, ...] = ("tick",)
    trails: float = 0.0
    still_every: int = 0
    own: int | None = None
    reference: float | None = None

    def __post_init__(self) -> None:
        check_output(self.path, size=self.size, fps=self.fps)
        check_look(style=self.style, overlays=self.overlays, trails=self.trails)


class Film:
    """Takes moments without ever waiting. Raises PictureError at once for what cannot be drawn as asked.

    `balls`: how many a moment has about (None: as many as the scene).
    """

    def __init__(self, scene: Scene, settings: FilmSettings, *, balls: int | None = None) -> None:
        _renderer(scene, settings)
        self.settings = settings
        self.taken = 0
        self.left_out = 0
        context = multiprocessing.get_context("spawn")
        most = max(
            64, WAITING_BYTES // (BYTES_PER_BALL * max(1, len(scene.balls) if balls is None else balls))
        )
        self._moments: Moments = context.Queue(most)
        self._result, result = context.Pipe(duplex=False)
        self._process = context.Process(
            target=_draw,
            args=(scene.to_message(), settings, self._moments, result),
            name="kuglice film",
            daemon=True,
        )
        self._process.start()
        result.close()

    def add(self, moment: Moment) -> None:
        """The next frame."""
        try:
            self._moments.put_nowait(moment)
            self.taken += 1
        except queue.Full:
            self.left_out += 1

    @property
    def waiting(self) -> int:
        """Frames that are not drawn yet."""
        return self._moments.qsize()

    def close(self, timeout: float) -> int:
        """Finish the film; returns the number of frames in it.

        Raises KugliceError if it failed or takes longer.
        """
        with contextlib.suppress(queue.Full):
            self._moments.put(None, timeout=timeout)
        outcome: Any = f"not finished after {timeout:g} s"
        with contextlib.suppress(EOFError):
            if self._result.poll(timeout):
                outcome = "the drawing process died"
                outcome = self._result.recv()
        self._process.join(1)
        if self._process.is_alive():
            self._process.terminate()
        self._moments.cancel_join_thread()
        if isinstance(outcome, int):
            return outcome
        raise KugliceError(f"film {self.settings.path}: {outcome}")


def _draw(
    scene_message: dict[str, Any], settings: FilmSettings, moments: Moments, result: Connection
) -> None:
    # Ctrl-C reaches the whole process group, but what was played so far should still become a film.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(STEPS_ASIDE)
    try:
        result.send(_film(Scene.from_message(scene_message), settings, moments))
    except Exception as error:
        result.send(f"{type(error).__name__}: {error}")
        # The parent must not hang on a full queue that nobody empties.
        while moments.get() is not None:
            pass


def _renderer(scene: Scene, settings: FilmSettings) -> Renderer:
    return Renderer(
        scene,
        size=settings.size,
        style=settings.style,
        overlays=settings.overlays,
        trails=settings.trails,
        own=settings.own,
        reference=settings.reference,
    )


def _film(scene: Scene, settings: FilmSettings, moments: Moments) -> int:
    renderer = _renderer(scene, settings)
    frames = 0
    settings.path.parent.mkdir(parents=True, exist_ok=True)
    with open_output(settings.path, size=settings.size, fps=settings.fps) as output:
        while (moment := moments.get()) is not None:
            pixels = renderer.frame(moment)
            output.write(pixels)
            frames += 1
            if settings.still_every and frames % settings.still_every == 0:
                still = settings.path.with_name(
                    f"{settings.path.stem}-{frames // settings.still_every:02d}.png"
                )
                still.write_bytes(encode_png(pixels))
    return frames
