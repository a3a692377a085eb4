"""Reading a replay, and running it again."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from os import PathLike
from pathlib import Path
from typing import Self

from kuglice import _core
from kuglice.errors import KugliceError, ReplayError
from kuglice.inputs import Input, unpack
from kuglice.model import Model
from kuglice.replay.difference import difference
from kuglice.replay.format import FORMAT, End, Head, State, Tick, read_replay
from kuglice.replay.verification import Mismatch, Verification
from kuglice.scene import Scene
from kuglice.world import World

__all__ = ["Replay"]


class Replay:
    """A recording. `load` has checked every record of it."""

    def __init__(
        self, path: Path, head: Head, ticks: list[Tick], states: dict[int, bytes], end: End | None
    ) -> None:
        self.path = path
        self.version = head.version
        """Of the package that recorded it."""
        self.step_version = head.step_version
        self.scene = Scene.from_message(head.scene)
        self.model = Model.from_message(head.model)
        self.start = head.tick
        self.complete = end is not None
        """Whether the recording was closed; otherwise it was cut off."""
        self._head, self._ticks, self._states, self._end = head, ticks, states, end

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Raises ReplayError for a file that is no replay, is damaged, or is not in order."""
        path = Path(path)
        try:
            head, ticks, states, end = _read(path)
            return cls(path, head, ticks, states, end)
        except OSError as error:
            raise ReplayError(f"{path}: cannot be read: {error.strerror}") from error
        except ReplayError:
            raise
        except KugliceError as error:
            raise ReplayError(f"{path}: {error}") from error

    def __len__(self) -> int:
        return len(self._ticks)

    def inputs(self, tick: int) -> list[Input]:
        """The inputs of a tick."""
        return unpack(self._ticks[tick - self.start].inputs)

    def worlds(self) -> Iterator[World]:
        """One world, yielded at the start and after every tick."""
        if self.step_version != _core.STEP_VERSION:
            raise ReplayError(
                f"{self.path}: recorded by step version {self.step_version}, this is {_core.STEP_VERSION}:"
                " other bits would come out"
            )
        world = World(self.scene, self.model)
        if self._head.state is not None:
            world = World.restore(self.scene, self._head.state, self.model)
        yield world
        for tick in self._ticks:
            world.step(tick.inputs, tick.dt)
            yield world

    def verify(self, watch: Callable[[World], None] | None = None) -> Verification:
        """Run it again and compare every hash, up to the first that differs. `watch` sees each state."""
        hashes = 0
        wrong: tuple[int, int, int] | None = None
        for world in self.worlds():
            if watch is not None:
                watch(world)
            expected = self._hash(world.tick)
            if wrong is None and expected is not None:
                found = world.state_hash
                hashes += 1
                if found != expected:
                    wrong = (world.tick, expected, found)
            if wrong is not None and world.tick in self._states:
                break
        if wrong is None:
            return Verification(len(self), hashes, self.complete, None)
        recorded = self._states.get(world.tick)
        mismatch = Mismatch(*wrong, None)
        if recorded is not None:
            expected_world = World.restore(self.scene, recorded, self.model)
            equal = expected_world.state_hash == world.state_hash
            mismatch = Mismatch(*wrong, difference(expected_world, world), only_hash=equal)
        return Verification(wrong[0] - self.start, hashes, self.complete, mismatch)

    def _hash(self, tick: int) -> int | None:
        if tick == self.start:
            return self._head.hash
        if self._end is not None and tick == self._end.tick:
            return self._end.hash
        return self._ticks[tick - self.start - 1].hash


def _read(path: Path) -> tuple[Head, list[Tick], dict[int, bytes], End | None]:
    records = read_replay(path)
    head = next(records, None)
    if not isinstance(head, Head):
        raise ReplayError(
            f"{path}: no head record: the recording was cut off before its first tick, or is none"
        )
    if head.format != FORMAT:
        raise ReplayError(f"{path}: format {head.format}, this version reads {FORMAT}")
    ticks: list[Tick] = []
    states: dict[int, bytes] = {}
    end: End | None = None
    for record in records:
        due = head.tick + len(ticks)
        if end is not None or isinstance(record, Head) or record.tick != due:
            raise ReplayError(f"{path}: a record of kind {record.kind} out of order, expected tick {due}")
        if isinstance(record, Tick):
            unpack(record.inputs)
            ticks.append(record)
        elif isinstance(record, State):
            states[record.tick] = record.data
        else:
            end = record
    return head, ticks, states, end
