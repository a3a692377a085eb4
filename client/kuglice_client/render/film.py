"""A run of a world as a film: what `kuglice render` and `kuglice replay --render` do."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike

from kuglice.errors import PictureError
from kuglice.world import World
from kuglice_client.render.moment import Moment, between
from kuglice_client.render.outputs import open_output
from kuglice_client.render.renderer import Renderer

__all__ = ["film"]


def film(
    worlds: Iterable[World],
    path: str | PathLike[str],
    *,
    fps: float = 30.0,
    speed: float = 1.0,
    size: tuple[int, int] = (1280, 720),
    style: str = "discs",
    overlays: tuple[str, ...] = ("tick",),
    trails: float = 0.0,
) -> int:
    """Draw the states that `worlds` yields, one per tick and the first one too; the number of frames.

    The same world may be yielded again and again as it moves. Frames lie 1 / fps seconds apart, between two
    states where they fall between two ticks; at a `speed` of 2 the film shows two seconds of the scene per
    second. The entry point of the group `kuglice.renderers`. Raises PictureError and MissingExtraError,
    before the second state is asked for.
    """
    if not 0 < speed <= 1e6:
        raise PictureError(f"speed {speed}: must be above 0 and at most 1e6 seconds per second")
    renderer = None
    output = None
    previous = None
    try:
        for world in worlds:
            if renderer is None or output is None:
                renderer = Renderer(world.scene, size=size, style=style, overlays=overlays, trails=trails)
                output = open_output(path, size=size, fps=fps)
                start, tick = world.time, 1 / world.scene.tick_rate
            due = start + output.frames * speed / fps
            if world.time < due - 1.5 * tick:
                # No frame lies between this state and the next one, so nobody need look at it.
                previous = None
                continue
            current = renderer.look(world)
            while due <= current.time:
                output.write(renderer.frame(_at(due, previous, current)))
                due = start + output.frames * speed / fps
            previous = current
    finally:
        if output is not None:
            output.close()
    return 0 if output is None else output.frames


def _at(time: float, previous: Moment | None, current: Moment) -> Moment:
    if previous is None or previous.time >= current.time:
        return current
    alpha = (time - previous.time) / (current.time - previous.time)
    return between(previous, current, min(max(alpha, 0.0), 1.0))
