"""What whoever joins or looks must know of the world that is served."""

from __future__ import annotations

from typing import Any

from kuglice import Balls, World, __version__, _core
from kuglice.picture import reference_speed
from kuglice.protocol import About, RegionTerms, ViewAbout
from kuglice_server.cadence import Cadence

__all__ = ["Description"]


class Description:
    """Of one run of the world called `name`. Reads nothing that changes: safe from any thread."""

    def __init__(self, name: str, world: World, *, epoch: int, cadence: Cadence, terms: RegionTerms) -> None:
        scene = world.scene
        self._cadence = cadence
        self._terms = terms
        self._reference_speed = reference_speed(scene)
        self._lasting: dict[str, Any] = {
            "epoch": epoch,
            "world": name,
            "version": __version__,
            "step_version": _core.STEP_VERSION,
            # Who joins gets the balls of today, by a snapshot or region by region, and has no use for those of the
            # start.
            "scene": {**scene.to_message(), "balls": Balls.none().to_message()},
            "model": world.model.to_message(),
            "rate": cadence.rate,
        }

    def about(self, *, tick: int) -> About:
        """What a client must know to join at that tick."""
        return About(
            **self._lasting,
            tick=tick,
            snapshot_every=self._cadence.snapshot_every,
            hash_every=self._cadence.hash_every,
            history_ticks=self._cadence.history,
        )

    def view_about(self, *, tick: int, balls: int) -> ViewAbout:
        """What a view must know at that tick, of a world of so many balls."""
        return ViewAbout(
            **self._lasting,
            tick=tick,
            balls=balls,
            reference_speed=self._reference_speed,
            regions=self._terms,
        )
