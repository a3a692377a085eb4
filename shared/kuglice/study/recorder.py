"""Writing a study while a client plays."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from kuglice import _core
from kuglice.closing import Closing
from kuglice.exclusive import make_folder, open_exclusive
from kuglice.inputs import Input, pack
from kuglice.replay.framing import write_record
from kuglice.study.format import MAGIC, Acted, Answered, DrawnFrame, Event, Joined, Rollback, State, Tick
from kuglice.version import VERSION
from kuglice.world import World

__all__ = ["StudyRecorder"]

SEEN_BYTES = 256 * 1024
"""Of positions per second: 540 balls in every frame of 60 per second, 10,000 in three."""
FLUSH_SECONDS = 1.0

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


class StudyRecorder(Closing):
    """Appends what happens to a client to a file (format.py). An existing file is replaced.

    Raises ReplayError if the file cannot be written, or if another recorder writes it.

    Every time `at` is in seconds of one clock. Frames say where balls were drawn as often as `seen_bytes` per second
    allow.
    """

    def __init__(self, path: str | PathLike[str], *, seen_bytes: float = SEEN_BYTES) -> None:
        make_folder(Path(path))
        self._file = open_exclusive(Path(path))
        self._file.write(MAGIC)
        self._seen_bytes = seen_bytes
        self._seen_after = float("-inf")
        self._ids: bytes | None = None
        self._flushed = float("-inf")

    def joined(
        self, at: float, world: World, *, name: str | None, number: int | None, epoch: int, rate: float
    ) -> None:
        """In a world, which is as the server has it."""
        event = Joined(
            at=at,
            version=VERSION,
            step_version=_core.STEP_VERSION,
            name=name,
            number=number,
            epoch=epoch,
            rate=rate,
            scene=world.scene.to_message(),
            model=world.model.to_message(),
            tick=world.tick,
            state=world.snapshot(),
        )
        self._ids = None
        self._add(event)

    def tick(self, at: float, tick: int, inputs: bytes, state_hash: int | None) -> None:
        """An authoritative tick was stepped; the hash is the server's, if it told one."""
        self._add(Tick(at=at, tick=tick, inputs=inputs, hash=state_hash))

    def state(self, at: float, world: World) -> None:
        """The server's state was taken."""
        self._add(State(at=at, tick=world.tick, data=world.snapshot()))

    def acted(self, at: float, given: Input, tick: int) -> None:
        """An own input was made, for `tick`."""
        self._add(Acted(at=at, sequence=given.sequence, tick=tick, input=pack([given])))

    def answered(self, at: float, sequence: int, tick: int | None, early: int | None) -> None:
        """What became of it."""
        self._add(Answered(at=at, sequence=sequence, tick=tick, early=early))

    def rollback(self, at: float, first: int, end: int) -> None:
        """Ticks [first, end) are predicted again."""
        self._add(Rollback(at=at, first=first, end=end))

    def frame(
        self, at: float, shown: World, alpha: float, confirmed: int, seen: Callable[[], tuple[Ids, Floats]]
    ) -> None:
        """A frame between the state before `shown` and `shown`; `seen` gives ids and places of the balls in it."""
        told: dict[str, bytes | int] = {}
        if at >= self._seen_after:
            ids, position = seen()
            names = ids.astype("<u8").tobytes()
            places = position.astype("<f4").tobytes()
            told = {"hash": shown.state_hash, "seen": places}
            if names != self._ids:
                told["ids"] = self._ids = names
            self._seen_after = at + len(places) / self._seen_bytes
        event = DrawnFrame(
            at=at,
            tick=shown.tick,
            alpha=alpha,
            confirmed=confirmed,
            **told,  # type: ignore[arg-type]
        )
        self._add(event)

    def close(self) -> None:
        """What was written is whole after this."""
        self._file.close()

    def _add(self, event: Event) -> None:
        write_record(self._file, event)
        if event.at - self._flushed >= FLUSH_SECONDS:
            self._flushed = event.at
            self._file.flush()
