"""Reading a study, and comparing what was seen with what the server's world was at that tick."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from kuglice import _core
from kuglice.blending import blend
from kuglice.errors import KugliceError, ReplayError
from kuglice.model import Model
from kuglice.scene import Scene
from kuglice.study.format import DrawnFrame, Event, Joined, State, Tick, read_study
from kuglice.world import World

__all__ = ["SeenFrame", "Study"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


@dataclass(frozen=True)
class SeenFrame:
    """A frame whose balls were recorded, against the authoritative states at its tick.

    `at`: seconds since the first event. `ahead`: ticks that the drawn state was ahead of the confirmed one. `right`:
    whether the predicted state had the very bits that the server's had in the end. Errors are distances between where
    a ball was drawn and where it should have been, in its radii: of all balls, and of one's own (None without one).
    """

    at: float
    tick: int
    ahead: int
    right: bool
    mean_error: float
    worst_error: float
    own_error: float | None


class _Placed(NamedTuple):
    ids: Ids
    position: Floats
    radius: Floats
    own: int | None
    state_hash: int


class Study:
    """A recording of a client (format.py); `load` has checked every record of it."""

    def __init__(self, path: Path, events: list[Event]) -> None:
        if not events or not isinstance(events[0], Joined):
            raise ReplayError(f"{path}: a study begins with joining a world, this one does not")
        self.path = path
        self.events = events
        self.joined = events[0]
        self.began = events[0].at

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Raises ReplayError for a file that is no study, or is damaged."""
        path = Path(path)
        try:
            return cls(path, list(read_study(path)))
        except OSError as error:
            raise ReplayError(f"{path}: cannot be read: {error.strerror}") from error

    def frames(self) -> Iterator[SeenFrame]:
        """Those whose balls were recorded and whose tick was confirmed, in the order of their ticks.

        Runs the authoritative inputs again. Raises ReplayError if that gives other states than the server's.
        """
        for part in self._parts():
            yield from self._compared(part)

    def _parts(self) -> Iterator[list[Event]]:
        """Events from each join to the next."""
        part: list[Event] = []
        for event in self.events:
            if isinstance(event, Joined) and part:
                yield part
                part = []
            part.append(event)
        yield part

    def _compared(self, events: list[Event]) -> Iterator[SeenFrame]:
        drawn: dict[int, list[tuple[DrawnFrame, Ids]]] = {}
        ids: Ids = np.empty(0, np.uint64)
        for event in events:
            if isinstance(event, DrawnFrame) and event.seen is not None:
                ids = ids if event.ids is None else np.frombuffer(event.ids, "<u8").astype(np.uint64)
                drawn.setdefault(event.tick, []).append((event, ids))
        before: _Placed | None = None
        for placed, tick in self._confirmed(events):
            for frame, names in drawn.pop(tick, []):
                if before is not None:
                    yield self._seen(frame, names, before, placed)
            before = placed

    def _confirmed(self, events: list[Event]) -> Iterator[tuple[_Placed, int]]:
        joined = events[0]
        assert isinstance(joined, Joined)
        if joined.step_version != _core.STEP_VERSION:
            raise ReplayError(
                f"{self.path}: recorded by step version {joined.step_version}, this is {_core.STEP_VERSION}:"
                " other bits would come out"
            )
        try:
            scene, model = Scene.from_message(joined.scene), Model.from_message(joined.model)
            world = World.restore(scene, joined.state, model)
            yield _placed(world, joined.number), world.tick
            for event in events:
                match event:
                    case Tick() if event.tick == world.tick:
                        world.step(event.inputs)
                        if event.hash not in (None, world.state_hash):
                            raise ReplayError(
                                f"{self.path}: state {world.tick}: hash {world.state_hash:016x}, the server told "
                                f"{event.hash:016x}"
                            )
                        yield _placed(world, joined.number), world.tick
                    case State():
                        world = World.restore(scene, event.data, model)
                        yield _placed(world, joined.number), world.tick
                    case _:
                        pass
        except ReplayError:
            raise
        except KugliceError as error:
            raise ReplayError(f"{self.path}: {error}") from error

    def _seen(self, frame: DrawnFrame, ids: Ids, before: _Placed, now: _Placed) -> SeenFrame:
        assert frame.seen is not None
        position = np.frombuffer(frame.seen, "<f4").astype(np.float64).reshape(-1, 2)
        if len(position) != len(ids):
            raise ReplayError(
                f"{self.path}: frame of tick {frame.tick}: {len(position)} places of {len(ids)} balls"
            )
        expected = blend(before.ids, before.position, now.ids, now.position, frame.alpha)
        shared, seen, here = np.intersect1d(ids, now.ids, assume_unique=True, return_indices=True)
        apart = position[seen] - expected[here]
        errors = np.hypot(apart[:, 0], apart[:, 1]) / now.radius[here]
        own = errors[shared == now.own] if now.own is not None else errors[:0]
        return SeenFrame(
            at=frame.at - self.began,
            tick=frame.tick,
            ahead=frame.tick - frame.confirmed,
            right=frame.hash == now.state_hash,
            mean_error=float(errors.mean()) if len(errors) else 0.0,
            worst_error=float(errors.max(initial=0.0)),
            own_error=float(own[0]) if len(own) else None,
        )


def _placed(world: World, number: int | None) -> _Placed:
    own = None if number is None else dict(world.players).get(number)
    return _Placed(world.id, world.position, world.radius, own, world.state_hash)
