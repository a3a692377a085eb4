"""Writing a replay while a world runs."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import Self

from kuglice import _core
from kuglice.errors import LimitError, ReplayError
from kuglice.inputs import Input, pack
from kuglice.replay.format import MAGIC, End, Head, State, Tick, write_record
from kuglice.version import VERSION
from kuglice.world import World

__all__ = ["Recorder"]

STATE_EVERY = 600


class Recorder:
    """Appends each tick of a world to a file, which is whole after every tick.

    Hashes are written every `hash_every` ticks; whole states every `state_every` and at the end, which is
    what can name the balls that differ. An existing file is replaced. Raises ReplayError if the file cannot
    be written.
    """

    def __init__(
        self,
        path: str | PathLike[str],
        world: World,
        *,
        hash_every: int = 1,
        state_every: int = STATE_EVERY,
    ) -> None:
        if hash_every < 1 or state_every < 1:
            raise LimitError(f"hash_every = {hash_every}, state_every = {state_every}: must be at least 1")
        self._world = world
        self._next = world.tick
        self._hash_every, self._state_every = hash_every, state_every
        head = Head(
            version=VERSION,
            step_version=_core.STEP_VERSION,
            scene=world.scene.to_message(),
            model=world.model.to_message(),
            tick=world.tick,
            hash=world.state_hash,
            state=world.snapshot() if world.tick else None,
            hash_every=hash_every,
        )
        try:
            self._file = Path(path).open("wb")  # noqa: SIM115 - close() ends what a whole run writes
        except OSError as error:
            raise ReplayError(f"{path}: cannot be written: {error.strerror}") from error
        self._file.write(MAGIC)
        write_record(self._file, head)
        self._file.flush()

    def add(self, inputs: Iterable[Input] | bytes = (), dt: float | None = None) -> None:
        """Record the tick that the world has just done, with the inputs it was given.

        Raises ReplayError if a tick was left out or recorded before.
        """
        if self._world.tick != self._next + 1:
            raise ReplayError(
                f"recorder: the world is at tick {self._world.tick}, expected {self._next + 1}:"
                " every tick is recorded once, right after its step"
            )
        records = inputs if isinstance(inputs, bytes) else pack(inputs)
        tick, self._next = self._next, self._next + 1
        hashed = self._world.state_hash if self._next % self._hash_every == 0 else None
        write_record(self._file, Tick(tick=tick, inputs=records, hash=hashed, dt=dt))
        if self._next % self._state_every == 0:
            write_record(self._file, State(tick=self._next, data=self._world.snapshot()))
        self._file.flush()

    def close(self) -> None:
        """Write the final state and hash. A file without them is a recording that was cut off."""
        if self._file.closed:
            return
        # The world may have moved on unrecorded; then its state is not that of the recording.
        if self._world.tick == self._next:
            if self._next % self._state_every:
                write_record(self._file, State(tick=self._next, data=self._world.snapshot()))
            write_record(self._file, End(tick=self._next, hash=self._world.state_hash))
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
