"""What a client saw, from its study, as a film: balls where they were drawn for its player."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from os import PathLike

import numpy as np

from kuglice.study import Seen
from kuglice_client.render.moment import HashState, Moment
from kuglice_client.render.outputs import open_output
from kuglice_client.render.renderer import Renderer

__all__ = ["film_of_seen"]


def film_of_seen(
    seen: Iterable[Seen],
    path: str | PathLike[str],
    *,
    fps: float = 30.0,
    size: tuple[int, int] = (1280, 720),
    own: int | None = None,
) -> int:
    """Draw frames as they were seen, at the times when they were; the number of frames of the film.

    Its hash is green where what was predicted has become true, red where it has not. `own`: number of the client.
    Raises PictureError and MissingExtraError.
    """
    renderer = output = last = None
    began = 0.0
    try:
        for one in seen:
            if renderer is None or output is None:
                renderer = Renderer(one.world.scene, size=size, overlays=("tick",), own=own)
                output = open_output(path, size=size, fps=fps)
                began = one.frame.at
            moment = _moment(one, began)
            # Where a frame of the film falls between two that were seen, the earlier one was on screen.
            while output.frames / fps <= moment.time:
                due = output.frames / fps
                output.write(renderer.frame(moment if last is None or due == moment.time else last))
            last = moment
    finally:
        if output is not None:
            output.close()
    return 0 if output is None else output.frames


def _moment(one: Seen, began: float) -> Moment:
    world, frame = one.world, one.frame
    true = frame.hash == world.state_hash
    shown = Moment.of(world, HashState(frame.hash or 0, frame.tick, "equal" if true else "different"))
    _, there, here = np.intersect1d(one.ids, world.id, assume_unique=True, return_indices=True)
    position = shown.position.copy()
    position[here] = one.position[there]
    return replace(shown, position=position, time=frame.at - began)
