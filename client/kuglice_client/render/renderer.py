"""Renderer: a style, overlays and trails put together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from kuglice.errors import PictureError
from kuglice.picture import Camera, background, reference_speed
from kuglice.scene import Scene
from kuglice.world import World
from kuglice_client.render.moment import HashState, Moment
from kuglice_client.render.overlays import OVERLAYS
from kuglice_client.render.stage import Layer, Pixels, Stage
from kuglice_client.render.styles import STYLES
from kuglice_client.render.trails import Trails
from kuglice_client.render.walls import draw_walls

__all__ = ["Renderer", "check_look"]


class Renderer:
    """Draws moments of one scene, all at the same size and in the same way.

    `style` and `overlays` name entries of STYLES and OVERLAYS; `trails` is the time in seconds after which a
    trail has all but gone, 0 for none; `own` is the client whose ball is marked as one's own; `reference` is
    the speed that gets the last colour, by default taken from the scene. Raises PictureError for a name, size
    or time that cannot be.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        size: tuple[int, int] = (1280, 720),
        style: str = "discs",
        overlays: Sequence[str] = (),
        trails: float = 0.0,
        own: int | None = None,
        reference: float | None = None,
    ) -> None:
        camera = Camera.fit(scene.box, size)
        speed = reference_speed(scene) if reference is None else reference
        if not speed > 0:
            raise PictureError(f"reference speed {speed}: must be above 0")
        self.stage = Stage(scene, camera, speed, own)
        self._style = _known("style", style, STYLES)
        self._overlays = [_known("overlay", name, OVERLAYS) for name in overlays]
        self._names = frozenset(overlays)
        self._background = background(camera, walls=scene.walls)
        self._trails = Trails(self._background, trails) if _duration(trails) else None
        self._pixels = np.empty_like(self._background)

    def look(self, world: World, hash_state: HashState | None = None) -> Moment:
        """A moment of a world: copies of what this renderer draws, and nothing else.

        `hash_state` is what is known about the world's agreement with a server; without it the overlay shows
        the hash of this world.
        """
        if hash_state is None and "tick" in self._names:
            hash_state = HashState(world.state_hash, world.tick)
        return Moment.of(world, hash_state, nodes="tree" in self._names)

    def frame(self, moment: Moment) -> Pixels:
        """(height, width, 3) bytes. The array is the renderer's own: the next frame draws over it."""
        if self._trails is None:
            np.copyto(self._pixels, self._background)
        else:
            np.copyto(self._pixels, self._trails.follow(self.stage, moment))
        draw_walls(self._pixels, self.stage, moment)
        self._style(self._pixels, self.stage, moment)
        for overlay in self._overlays:
            overlay(self._pixels, self.stage, moment)
        return self._pixels


def check_look(*, style: str, overlays: Sequence[str], trails: float) -> None:
    """Raises PictureError for what no Renderer can draw, whatever the scene."""
    _known("style", style, STYLES)
    for name in overlays:
        _known("overlay", name, OVERLAYS)
    _duration(trails)


def _known(what: str, name: str, table: Mapping[str, Layer]) -> Layer:
    if name not in table:
        raise PictureError(f"{what} {name!r}: there is none of that name, only {', '.join(table)}")
    return table[name]


def _duration(trails: float) -> float:
    if not 0 <= trails <= 3600:
        raise PictureError(f"trails {trails}: must be within 0 and 3600 seconds")
    return trails
