"""How far a server has come, as it writes it down: what to wait for, however long a busy machine takes."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

from e2e.processes import Command, until
from kuglice.errors import ReplayError
from kuglice.replay import Replay

__all__ = ["Recording"]

PATIENCE_SECONDS = 120.0
LOOK_SECONDS = 0.1
"""Between two looks, each of which reads it all."""
LEAST_INPUTS = 20


class Recording:
    """`path` is written by a server that runs."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __len__(self) -> int:
        """Ticks that it holds by now."""
        replay = self._replay()
        return 0 if replay is None else len(replay)

    def go_on(self, ticks: int) -> int:
        """Let the server make so many ticks more; returns the one that it has reached."""
        wanted = len(self) + ticks
        self._until(lambda: len(self) >= wanted, f"{ticks} more ticks")
        return wanted

    def acted(self, *players: Command) -> None:
        """Let each of the players that have joined act a good many times, and hear of it."""
        for player in players:
            number = int(re.findall(r"joined world .* as client (\d+)", player.err)[-1])
            self._until(lambda number=number: self._inputs(number) >= LEAST_INPUTS, f"inputs of {number}")

    def _inputs(self, number: int) -> int:
        replay = self._replay()
        ticks = [] if replay is None else range(replay.start, replay.start + len(replay))
        return sum(given.client == number for tick in ticks for given in replay.inputs(tick))

    def _replay(self) -> Replay | None:
        # The server may be about to begin it.
        with suppress(ReplayError):
            return Replay.load(self.path)
        return None

    @staticmethod
    def _until(condition, what: str) -> None:
        until(condition, seconds=PATIENCE_SECONDS, every=LOOK_SECONDS, what=what)
