"""How a world is served, as its user asks for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from kuglice.errors import ProtocolError
from kuglice.protocol import DEFAULT_ENDPOINT, check_endpoints, refuse_exposed

__all__ = ["ServerSettings", "check_rate"]

MAX_GRACE = 3600.0
LOWEST_RATE = 0.001
MAX_RATE = 10_000
MAX_REGION_RATE = 1000


@dataclass(frozen=True)
class ServerSettings:
    """How a world is served; none of it changes its bits.

    `rate`: ticks per second of wall clock (None: the scene's). `snapshot_every`: ticks between published
    snapshots (None: a second's worth). `hash_every`: ticks between states whose hash is told (None: every one,
    or one per second where that would cost too much). `grace`: seconds for which a player whose link was cut
    keeps its ball, and 1 at the least: who has only opened another link is known by then. `region_rate`: times
    per second that views are told of what they look at. `threads`: how many share the work of a step.
    `insecure`: listen on addresses that others can reach, although there are no accounts and no encryption yet.
    """

    world: str
    listen: Sequence[str] = (DEFAULT_ENDPOINT,)
    connect: Sequence[str] = ()
    rate: float | None = None
    snapshot_every: int | None = None
    hash_every: int | None = None
    region_rate: float = 10.0
    record: Path | None = None
    grace: float = 10.0
    threads: int = 1
    insecure: bool = False

    def __post_init__(self) -> None:
        if not self.listen and not self.connect:
            raise ProtocolError("endpoints: none to listen on and none to connect to")
        check_endpoints((*self.listen, *self.connect))
        if not self.insecure:
            refuse_exposed(self.listen)
        if self.snapshot_every is not None and self.snapshot_every < 1:
            raise ProtocolError(f"snapshot-every {self.snapshot_every}: must be at least 1 tick")
        if self.hash_every is not None and self.hash_every < 1:
            raise ProtocolError(f"hash-every {self.hash_every}: must be at least 1 tick")
        if not LOWEST_RATE <= self.region_rate <= MAX_REGION_RATE:
            raise ProtocolError(
                f"region-rate {self.region_rate}: must be at least {LOWEST_RATE} and at most "
                f"{MAX_REGION_RATE} times per second"
            )
        if not 0 <= self.grace <= MAX_GRACE:
            raise ProtocolError(f"grace {self.grace}: must be at least 0 and at most {MAX_GRACE:g} seconds")
        if self.rate is not None:
            check_rate("rate", self.rate)


def check_rate(what: str, rate: float) -> float:
    """`rate` as it is; raises ProtocolError where nobody could be served at so many ticks per second of wall clock."""
    if not LOWEST_RATE <= rate <= MAX_RATE:
        raise ProtocolError(
            f"{what} {rate:g}: must be at least {LOWEST_RATE} and at most {MAX_RATE} ticks per second"
        )
    return rate
