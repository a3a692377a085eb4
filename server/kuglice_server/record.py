"""The run as a replay file, whole after every tick, so that a killed server leaves what it had."""

from __future__ import annotations

import logging
from pathlib import Path

from kuglice import World
from kuglice.exclusive import make_folder
from kuglice.protocol import StretchedTick
from kuglice.replay import Recorder

__all__ = ["Record"]

log = logging.getLogger(__name__)


class Record:
    """A replay file that grows. An existing one is replaced, but never one that another server still writes.

    Raises ReplayError if it cannot be begun.
    """

    def __init__(self, path: Path, world: World) -> None:
        self._path = path
        make_folder(path)
        self._recorder: Recorder | None = Recorder(path, world)

    def add(self, entry: StretchedTick) -> None:
        """Write the tick that the world has just done. A full disk ends the record, not the server."""
        if self._recorder is None:
            return
        try:
            self._recorder.add(entry.inputs)
        except OSError as error:
            log.error("record %s ends before tick %d: %s", self._path, entry.tick, error)
            self._recorder = None

    def close(self) -> None:
        """Write the end."""
        if self._recorder is None:
            return
        try:
            self._recorder.close()
        except OSError as error:
            log.error("record %s has no end: %s", self._path, error)
