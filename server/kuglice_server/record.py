"""The run as a replay file, written tick by tick, so that a killed server leaves what it had."""

from __future__ import annotations

from pathlib import Path

from kuglice import World
from kuglice.protocol import StretchedTick

__all__ = ["Record"]


class Record:
    """A replay file that grows."""

    def __init__(self, path: Path, world: World) -> None:
        from kuglice.replay import Recorder

        path.parent.mkdir(parents=True, exist_ok=True)
        self._recorder = Recorder(path, world)

    def add(self, entry: StretchedTick) -> None:
        """Write a tick."""
        self._recorder.add(entry.inputs, entry.state_hash)

    def close(self) -> None:
        """Write the end."""
        self._recorder.close()
