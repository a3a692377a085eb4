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

__all__ = ["Seen", "SeenFrame", "Study"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


@dataclass(frozen=True)
class SeenFrame:
    """A frame whose balls were recorded, against the authoritative states at its tick.

    `at`: seconds since the first event. `ahead`: ticks that the drawn state was ahead of the confirmed one.
    `predicted_equal`: whether the predicted state had the very bits that the server's had in the end. Errors are
    distances between where a ball was drawn and where it should have been, in its radii: of all balls, and of one's own
    (None without one).
    """

    at: float
    tick: int
    ahead: int
    predicted_equal: bool
    mean_error: float
    worst_error: float
    own_error: float | None


class Seen(NamedTuple):
    """A frame whose balls were recorded: `ids` were drawn at `position` (n, 2).

    `world` is the server's state(frame.tick), `before` the one before it. Both move on with the next frame.
    """

    frame: DrawnFrame
    ids: Ids
    position: Floats
    before: World
    world: World


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
        """Frames whose balls were recorded, compared with the server's states; as `seen`."""
        for part in self._parts():
            number = part[0].number if isinstance(part[0], Joined) else None
            for one in self._seen(part):
                yield self._compared(one, number)

    def seen(self) -> Iterator[Seen]:
        """Frames whose balls were recorded and whose tick was confirmed, in the order of their ticks.

        Runs the authoritative inputs again. Raises ReplayError if that gives other states than the server's.
        """
        for part in self._parts():
            yield from self._seen(part)

    def _parts(self) -> Iterator[list[Event]]:
        """Events from each join to the next."""
        part: list[Event] = []
        for event in self.events:
            if isinstance(event, Joined) and part:
                yield part
                part = []
            part.append(event)
        yield part

    def _seen(self, events: list[Event]) -> Iterator[Seen]:
        drawn: dict[int, list[tuple[DrawnFrame, Ids, Floats]]] = {}
        ids: Ids = np.empty(0, np.uint64)
        for event in events:
            if isinstance(event, DrawnFrame) and event.seen is not None:
                ids = ids if event.ids is None else np.frombuffer(event.ids, "<u8").astype(np.uint64)
                position = np.frombuffer(event.seen, "<f4").astype(np.float64).reshape(-1, 2)
                if len(position) != len(ids):
                    raise ReplayError(
                        f"{self.path}: frame of tick {event.tick}: {len(position)} places of {len(ids)} balls"
                    )
                drawn.setdefault(event.tick, []).append((event, ids, position))
        before: World | None = None
        for world in self._confirmed(events):
            for frame in drawn.pop(world.tick, []) if before is not None else []:
                assert before is not None
                yield Seen(*frame, before, world)
            before = world.clone() if before is None else before
            before.copy_from(world)

    def _confirmed(self, events: list[Event]) -> Iterator[World]:
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
            yield world
            for event in events:
                match event:
                    case Tick() if event.tick == world.tick:
                        world.step(event.inputs)
                        if event.hash not in (None, world.state_hash):
                            raise ReplayError(
                                f"{self.path}: state {world.tick}: hash {world.state_hash:016x}, the server told "
                                f"{event.hash:016x}"
                            )
                        yield world
                    case State():
                        world = World.restore(scene, event.data, model)
                        yield world
                    case _:
                        pass
        except ReplayError:
            raise
        except KugliceError as error:
            raise ReplayError(f"{self.path}: {error}") from error

    def _compared(self, one: Seen, number: int | None) -> SeenFrame:
        frame, before, world = one.frame, one.before, one.world
        expected = blend(before.id, before.position, world.id, world.position, frame.alpha)
        shared, seen, here = np.intersect1d(one.ids, world.id, assume_unique=True, return_indices=True)
        apart = one.position[seen] - expected[here]
        errors = np.hypot(apart[:, 0], apart[:, 1]) / world.radius[here]
        ball = None if number is None else dict(world.players).get(number)
        own = errors[:0] if ball is None else errors[shared == ball]
        return SeenFrame(
            at=frame.at - self.began,
            tick=frame.tick,
            ahead=frame.tick - frame.confirmed,
            predicted_equal=frame.hash == world.state_hash,
            mean_error=float(errors.mean()) if len(errors) else 0.0,
            worst_error=float(errors.max(initial=0.0)),
            own_error=float(own[0]) if len(own) else None,
        )
