"""Writing a replay while a world runs."""

from __future__ import annotations

import math
from collections.abc import Iterable
from os import PathLike
from pathlib import Path

from kuglice import _core
from kuglice.closing import Closing
from kuglice.errors import LimitError, ReplayError
from kuglice.exclusive import open_exclusive
from kuglice.inputs import Input, pack
from kuglice.replay.format import MAGIC, End, Head, State, Tick
from kuglice.replay.framing import write_record
from kuglice.version import VERSION
from kuglice.world import World

__all__ = ["Recorder"]

STATE_BYTES = 64 * 1024
"""Whole states per second of play, in bytes, unless `state_every` says otherwise: 230 MB an hour at most."""
LEAST_TICKS = 10
"""Between two states of a small world."""


class Recorder(Closing):
    """Appends each tick of a world to a file, which is whole after every tick.

    Hashes are written every `hash_every` ticks; whole states every `state_every` and at the end, which is
    what can name the balls that differ: chaos spreads from the first of them until the next state. None
    writes states as often as 64 KiB per second of play allow, at least 10 ticks apart. An existing file is
    replaced. Raises ReplayError if the file cannot be written, or if another recorder writes it.
    """

    def __init__(
        self,
        path: str | PathLike[str],
        world: World,
        *,
        hash_every: int = 1,
        state_every: int | None = None,
    ) -> None:
        if hash_every < 1 or (state_every is not None and state_every < 1):
            raise LimitError(f"hash_every = {hash_every}, state_every = {state_every}: must be at least 1")
        self._world = world
        self._next = self._last_state = world.tick
        self._hash_every, self._state_every = hash_every, state_every
        snapshot = world.snapshot()
        self._due_after = self._ticks_between(snapshot)
        head = Head(
            version=VERSION,
            step_version=_core.STEP_VERSION,
            scene=world.scene.to_message(),
            model=world.model.to_message(),
            tick=world.tick,
            hash=world.state_hash,
            state=snapshot if world.tick else None,
            hash_every=hash_every,
        )
        self._file = open_exclusive(Path(path))
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
        if self._next - self._last_state >= self._due_after:
            self._write_state()
        self._file.flush()

    def close(self) -> None:
        """Write the final state and hash. A file without them is a recording that was cut off."""
        if self._file.closed:
            return
        # The world may have moved on unrecorded; then its state is not that of the recording.
        if self._world.tick == self._next:
            if self._next > self._last_state:
                self._write_state()
            write_record(self._file, End(tick=self._next, hash=self._world.state_hash))
        self._file.close()

    def _write_state(self) -> None:
        snapshot = self._world.snapshot()
        write_record(self._file, State(tick=self._next, data=snapshot))
        self._last_state, self._due_after = self._next, self._ticks_between(snapshot)

    def _ticks_between(self, snapshot: bytes) -> int:
        """Spawns and removals change the size, so every state decides when the next is due."""
        if self._state_every is not None:
            return self._state_every
        affordable = math.ceil(len(snapshot) * self._world.scene.tick_rate / STATE_BYTES)
        return max(affordable, LEAST_TICKS)
