"""Who plays, where and how."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from kuglice.errors import ProtocolError
from kuglice.protocol import DEFAULT_ENDPOINT, check_endpoints, check_name
from kuglice_client.bots import BOTS, Bot
from kuglice_client.correction import LIMIT_RADII, SECONDS

__all__ = ["ClientSettings"]

MAX_INPUT_DELAY = 30


@dataclass(frozen=True)
class ClientSettings:
    """`name`: who we are, None for a spectator. `bot`: who plays for us, an entry of BOTS or a function like them.

    `wait`: seconds that joining may take, again after a restart of the server; the error at their end names them.
    Whatever they are, a server has one whole try to be reached, and a second to answer. `lose`: called with the number
    of each tick message; those for which it says True are thrown away on arrival, to see them heal.
    `input_delay`: ticks between acting and the effect, for those who prefer fewer corrections of others to
    acting at once. `exact_inputs`: send every bit of a force instead of two bytes per number
    (kuglice.inputs.rounded). `check_snapshots`: compare the server's published snapshots too, byte by byte;
    hashes are compared anyway, and snapshots cost most of the traffic. `desync_reports`: a directory that gets
    a file per desync. `study`: where to record what is seen, acted and confirmed (kuglice.study).
    `correction_seconds`, `correction_limit`: how long the picture glides to where a correction puts a ball, and
    beyond how many radii it jumps there (correction.py).
    """

    connect: tuple[str, ...] = (DEFAULT_ENDPOINT,)
    world: str | None = None
    name: str | None = None
    bot: str | Bot | None = None
    wait: float = 10.0
    lose: Callable[[int], bool] | None = None
    input_delay: int = 0
    exact_inputs: bool = False
    check_snapshots: bool = False
    desync_reports: Path | None = None
    study: Path | None = None
    correction_seconds: float = SECONDS
    correction_limit: float = LIMIT_RADII

    def __post_init__(self) -> None:
        check_endpoints(self.connect)
        if self.world is not None:
            check_name("world", self.world)
        if self.name is not None:
            check_name("client", self.name)
        if isinstance(self.bot, str) and self.bot not in BOTS:
            raise ProtocolError(f"bot {self.bot!r}: there is none of that name, only {', '.join(BOTS)}")
        if self.bot is not None and self.name is None:
            raise ProtocolError(f"bot {self.bot!r}: needs a client name to play under")
        if not self.wait >= 0:
            raise ProtocolError(f"wait {self.wait:g}: must be at least 0 seconds")
        if not 0 <= self.input_delay <= MAX_INPUT_DELAY:
            raise ProtocolError(
                f"input delay {self.input_delay}: must be within 0 and {MAX_INPUT_DELAY} ticks"
            )
