"""How often a server does what, in its ticks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from kuglice import World
from kuglice_server.settings import ServerSettings, check_rate

__all__ = ["Cadence"]

HISTORY_SECONDS = 60
LEAST_HISTORY = 600
EARLIEST_SECONDS = 2
LEAST_GRACE_SECONDS = 1.0
"""Of a client that opens its link anew the end of the old session may be told first, or last. By then it has been told
of again, or heard: it speaks ten times per second."""
HASHED_BALLS = 100_000
"""Up to so many balls every state's hash is told."""


@dataclass(frozen=True)
class Cadence:
    """`rate`: ticks per second. All else in ticks: between snapshots, between hashes, between two messages about one
    region; how many are kept for those who missed some; how early an input may come; how long one who is away is
    waited for.
    """

    rate: float
    snapshot_every: int
    hash_every: int
    region_every: int
    history: int
    horizon: int
    grace: int

    @classmethod
    def of(cls, settings: ServerSettings, world: World) -> Self:
        """What the settings say, and what suits the world where they say nothing. Raises ProtocolError."""
        rate = settings.rate
        if rate is None:
            rate = check_rate("the scene's tick_rate", world.scene.tick_rate)
        second = max(1, round(rate))
        return cls(
            rate=rate,
            snapshot_every=settings.snapshot_every or second,
            hash_every=settings.hash_every or (1 if world.count <= HASHED_BALLS else second),
            region_every=max(1, round(rate / settings.region_rate)),
            history=max(LEAST_HISTORY, round(HISTORY_SECONDS * rate)),
            horizon=max(1, round(EARLIEST_SECONDS * rate)),
            grace=max(1, round(max(settings.grace, LEAST_GRACE_SECONDS) * rate)),
        )

    @property
    def region_rate(self) -> float:
        """Times per second that a region is told, as whole ticks allow."""
        return self.rate / self.region_every
