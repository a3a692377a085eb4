"""Joining: find the world, learn its scene and model, get a number, restore the newest snapshot.

The tick stream is subscribed to, and buffered, before any of this begins: whatever happens between the
snapshot and the first buffered tick is in the server's history, and everything later in the buffer.
"""

from __future__ import annotations

import logging
import threading
import time
from dataclasses import dataclass

from kuglice import Model, Scene, World, _core
from kuglice.errors import JoinError, KugliceError, ProtocolError
from kuglice.protocol import (
    ANY_EPOCH,
    ANY_STATUS,
    About,
    ArrivalRequest,
    Keys,
    SnapshotRequest,
    Status,
    decode,
)
from kuglice_client.ask import Asked
from kuglice_client.link import Link

__all__ = ["Joined", "find_world", "join", "patience"]

log = logging.getLogger(__name__)

RETRY_SECONDS = 0.03
ANSWER_SECONDS = 5.0
LEAST_ANSWER_SECONDS = 1.0
SNAPSHOT_SECONDS = 30.0
"""For a state to arrive: a large one takes its time on a thin link."""

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
    told_at: float
    """When `about`, with the tick that it was told at, had come; in seconds of the monotonic clock."""


def find_world(link: Link, *, deadline: float, stop: threading.Event) -> str:
    """Name of the only world that is served here. Raises JoinError if there is none, or more than one."""
    while True:
        try:
            replies = link.ask(ANY_STATUS, None, timeout=patience(deadline)).wait(stop)
            break
        except JoinError:
            _pause(
                link,
                deadline,
                stop,
                why=f"no world is served at {link.endpoints}: is the server behind it running?",
            )
    worlds = sorted({decode(reply, Status).world for reply in replies})
    if len(worlds) > 1:
        raise JoinError(f"worlds {', '.join(worlds)} are served here: say which one with --world")
    return worlds[0]


def join(
    link: Link,
    keys: Keys,
    who: Who | None,
    *,
    deadline: float,
    stop: threading.Event,
) -> Joined:
    """Join as the client `who`, whose liveliness token is declared already, or as a spectator (None).

    Raises JoinError at the deadline, when refused, or when this build would step to other bits than the
    server.
    """
    while True:
        try:
            return _attempt(link, keys, who, deadline=deadline, stop=stop)
        except _NotYetError as error:
            log.debug("not yet: %s", error)
            _pause(link, deadline, stop, why=str(error))


class _NotYetError(JoinError):
    """A reason that time may heal."""


def _attempt(
    link: Link,
    keys: Keys,
    who: Who | None,
    *,
    deadline: float,
    stop: threading.Event,
) -> Joined:
    asked_at = time.monotonic()
    asked_about = link.ask(keys.about, None, timeout=patience(deadline))
    # At once and not in turn: on a long way every question costs a round trip, and a state takes several.
    asked_snapshot = link.ask(
        keys.history, SnapshotRequest(epoch=ANY_EPOCH, at=None), timeout=SNAPSHOT_SECONDS
    )
    asked_number = None if who is None else _ask_number(link, keys, who, deadline=deadline)
    try:
        about = decode(asked_about.wait_whole(stop).data, About)
    except JoinError as error:
        raise _NotYetError(f"world {keys.world} at {link.endpoints}: {error}") from error
    except ProtocolError as error:
        raise JoinError(f"{keys.about}: {error}") from error
    told_at = time.monotonic()
    round_trip = told_at - asked_at
    if about.step_version != _core.STEP_VERSION:
        raise JoinError(
            f"step version {about.step_version} of the server (kuglice {about.version}): this client has "
            f"{_core.STEP_VERSION} and would compute other bits"
        )
    number, sequence = None, 0
    if who is not None and asked_number is not None:
        number, sequence = _number(link, keys, who, asked_number, deadline=deadline, stop=stop)
    try:
        snapshot = asked_snapshot.wait_whole(stop)
    except JoinError as error:
        raise _NotYetError(str(error)) from error
    state_seconds = time.monotonic() - asked_at
    if snapshot.epoch != about.epoch:
        raise _NotYetError(f"epoch {about.epoch} is over, {snapshot.epoch} has begun")
    try:
        scene = Scene.from_message(about.scene)
        model = Model.from_message(about.model)
        world = World.restore(scene, snapshot.data, model)
    except KugliceError as error:
        raise JoinError(f"world {about.world}: {error}") from error
    return Joined(
        about.epoch, about, scene, model, world, number, sequence, round_trip, state_seconds, told_at
    )


def _number(
    link: Link,
    keys: Keys,
    who: Who,
    asked: Asked,
    *,
    deadline: float,
    stop: threading.Event,
) -> tuple[int, int]:
    name, session = who
    while True:
        try:
            status = decode(asked.wait(stop)[0], Status)
        except (JoinError, ProtocolError) as error:
            raise _NotYetError(str(error)) from error
        for refusal in status.refusals:
            if (refusal.name, refusal.session) == who:
                raise JoinError(f"client {name}: {refusal.reason}")
        here = status.clients.get(name)
        if here is not None and here.session == session:
            return here.number, here.sequence
        why = "the server has not let it in"
        if here is not None and here.away:
            why = "another session plays it, whose link is cut: the server still waits for that one"
        _pause(link, deadline, stop, why=f"client {name}: {why}")
        asked = _ask_number(link, keys, who, deadline=deadline)


def _ask_number(link: Link, keys: Keys, who: Who, *, deadline: float) -> Asked:
    name, session = who
    request = ArrivalRequest(epoch=ANY_EPOCH, name=name, session=session)
    return link.ask(keys.status, request, timeout=patience(deadline))


def patience(deadline: float) -> float:
    """Seconds to wait for one answer: until the deadline, but a second at least, and not for ever."""
    return max(LEAST_ANSWER_SECONDS, min(ANSWER_SECONDS, deadline - time.monotonic()))


def _pause(link: Link, deadline: float, stop: threading.Event, why: str) -> None:
    if stop.wait(RETRY_SECONDS):
        raise JoinError("stopped while joining")
    if time.monotonic() > deadline:
        raise JoinError(why)
    link.revive()
