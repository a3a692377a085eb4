"""A run of a world as a film: what `kuglice render` and `kuglice replay --render` do."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike

from kuglice.world import World
from kuglice_client.render.moment import between
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
    renderer = None
    output = None
    try:
        for world in worlds:
            if renderer is None or output is None:
                renderer = Renderer(world.scene, size=size, style=style, overlays=overlays, trails=trails)
                output = open_output(path, size=size, fps=fps)
                previous = current = renderer.look(world)
                start = current.time
            else:
                previous, current = current, renderer.look(world)
            while (due := start + output.frames * speed / fps) <= current.time:
                span = current.time - previous.time
                alpha = 1.0 if span == 0 else (due - previous.time) / span
                output.write(renderer.frame(between(previous, current, min(max(alpha, 0.0), 1.0))))
    finally:
        if output is not None:
            output.close()
    return 0 if output is None else output.frames
