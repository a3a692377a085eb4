"""Joining: find the world, learn its scene and model, get a number, restore the newest snapshot.

The tick stream is subscribed to, and buffered, before any of this begins: whatever happens between the
snapshot and the first buffered tick is in the server's history, and everything later in the buffer.
"""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass

from kuglice import Model, Scene, World, _core
from kuglice.errors import JoinError, KugliceError, ProtocolError
from kuglice.protocol import (
    ANY_EPOCH,
    ANY_STATUS,
    About,
    Admission,
    ArrivalRequest,
    Keys,
    Payload,
    SnapshotRequest,
    Status,
    decode,
)
from kuglice_client.link import Asked, NotYetError, Waiting

__all__ = ["Joined", "Who", "arrival", "find_world", "join"]

log = logging.getLogger(__name__)

SNAPSHOT_SECONDS = 30.0
"""For a state to arrive before it is asked for again: a large one takes its time on a thin link."""
DOUBTED_SECONDS = 0.4
"""An answer that took longer says little of which tick it is now: it may have come behind the state."""

Who = tuple[str, str]
"""Name and session."""


@dataclass(frozen=True)
class Joined:
    """What came out of joining.

    `number` is None for a spectator; `sequence` is the last one the server saw of us.
    """

    epoch: int
    about: About
    scene: Scene
    model: Model
    world: World
    number: int | None
    sequence: int
    round_trip: float
    state_seconds: float
    """For which the state was on its way."""
    told_tick: int
    """The tick that the server said it was at."""
    told_at: float
    """When that had come, in seconds of the monotonic clock."""


def find_world(waiting: Waiting) -> str:
    """Name of the only world that is served here. Raises JoinError if there is none, or more than one."""
    link = waiting.link

    def attempt() -> list[Payload]:
        try:
            return link.ask(ANY_STATUS, None, timeout=waiting.answer_seconds()).wait(waiting.stop)
        except JoinError as error:
            raise NotYetError(
                f"no world is served at {link.endpoints}: is the server behind it running?"
            ) from error

    replies = waiting.until_done(attempt)
    worlds = sorted({decode(reply, Status).world for reply in replies})
    if len(worlds) > 1:
        raise JoinError(f"worlds {', '.join(worlds)} are served here: say which one with --world")
    return worlds[0]


def join(waiting: Waiting, keys: Keys, who: Who | None) -> Joined:
    """Join as the client `who`, whose liveliness token is declared already, or as a spectator (None).

    Raises JoinError when refused, when this build would step to other bits than the server, or, with what it waited
    for and how long, when the time to wait is over: no answer is waited for any longer, not even the state.
    """
    return waiting.until_done(lambda: _attempt(waiting, keys, who))


def arrival(who: Who) -> ArrivalRequest:
    """The question how it stands with that name and session, whatever run of the server hears it."""
    name, session = who
    return ArrivalRequest(epoch=ANY_EPOCH, name=name, session=session)


def _attempt(waiting: Waiting, keys: Keys, who: Who | None) -> Joined:
    link, stop = waiting.link, waiting.stop
    asked_at = time.monotonic()
    asked_about = link.ask(keys.about, None, timeout=waiting.answer_seconds())
    # At once and not in turn: on a long way every question costs a round trip, and a state takes several.
    asked_snapshot = link.ask(
        keys.history,
        SnapshotRequest(epoch=ANY_EPOCH, at=None),
        timeout=waiting.answer_seconds(SNAPSHOT_SECONDS),
    )
    admission = None if who is None else _Admission(waiting, keys, who)
    try:
        about = decode(asked_about.wait_whole(stop).data, About)
    except JoinError as error:
        raise NotYetError(f"world {keys.world} at {link.endpoints}: {error}") from error
    except ProtocolError as error:
        raise JoinError(f"{keys.about}: {error}") from error
    told = _Told(about.tick, time.monotonic())
    if about.step_version != _core.STEP_VERSION:
        raise JoinError(
            f"step version {about.step_version} of the server (kuglice {about.version}): this client has "
            f"{_core.STEP_VERSION} and would compute other bits"
        )
    number, sequence = (None, 0) if admission is None else admission.wait()
    try:
        snapshot = asked_snapshot.wait_whole(stop)
    except JoinError as error:
        raise NotYetError(str(error)) from error
    state_seconds = time.monotonic() - asked_at
    if snapshot.epoch != about.epoch:
        raise NotYetError(f"epoch {about.epoch} is over, {snapshot.epoch} has begun")
    if told.at - asked_at > DOUBTED_SECONDS:
        # Only now that nothing large is under way any more is the answer as old as the way is long.
        told = _told_again(waiting, keys, about, before=told)
    try:
        scene = Scene.from_message(about.scene)
        model = Model.from_message(about.model)
        world = World.restore(scene, snapshot.data, model)
    except KugliceError as error:
        raise JoinError(f"world {about.world}: {error}") from error
    return Joined(
        about.epoch,
        about,
        scene,
        model,
        world,
        number,
        sequence,
        link.quickest_answer,
        state_seconds,
        told.tick,
        told.at,
    )


@dataclass(frozen=True)
class _Told:
    tick: int
    at: float


def _told_again(waiting: Waiting, keys: Keys, about: About, *, before: _Told) -> _Told:
    """Which tick it is by a new answer, or as it was told `before` if none comes, or one of another run."""
    try:
        asked = waiting.link.ask(keys.status, None, timeout=waiting.answer_seconds())
        status = decode(asked.wait(waiting.stop)[0], Status)
    except (JoinError, ProtocolError) as error:
        log.debug("%s", error)
        return before
    return _Told(status.tick, time.monotonic()) if status.epoch == about.epoch else before


class _Admission:
    """Asked for when made: a number under which to play."""

    def __init__(self, waiting: Waiting, keys: Keys, who: Who) -> None:
        self._waiting = waiting
        self._key = keys.status
        self._who = who
        self._asked = self._ask()

    def wait(self) -> tuple[int, int]:
        """Number, and the last sequence number that the server saw. Raises JoinError if refused, NotYetError."""
        name, _ = self._who
        while True:
            try:
                told = decode(self._asked.wait(self._waiting.stop)[0], Admission)
            except (JoinError, ProtocolError) as error:
                raise NotYetError(str(error)) from error
            if told.refused is not None:
                raise JoinError(f"client {name}: {told.refused}")
            if told.number is not None:
                return told.number, told.sequence
            why = "the server has not let it in"
            if told.kept:
                why = "another session plays it, whose link is cut: the server still waits for that one"
            self._waiting.pause(why=f"client {name}: {why}")
            self._asked = self._ask()

    def _ask(self) -> Asked:
        return self._waiting.link.ask(self._key, arrival(self._who), timeout=self._waiting.answer_seconds())
