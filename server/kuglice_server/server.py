"""The authority over one world: intake, tick loop, publishing and answering around one Zenoh session."""

from __future__ import annotations

import logging
import threading
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import zenoh

from kuglice import Balls, Scene, World, __version__, _core
from kuglice.errors import ProtocolError
from kuglice.picture import reference_speed
from kuglice.protocol import (
    DEFAULT_ENDPOINT,
    About,
    Declared,
    Keys,
    Status,
    ViewAbout,
    close_session,
    open_session,
    refuse_exposed,
    server_configuration,
)
from kuglice_server.answer import Answers
from kuglice_server.history import History
from kuglice_server.intake import Intake
from kuglice_server.players import Players
from kuglice_server.publish import Publisher
from kuglice_server.record import Record
from kuglice_server.regions import RegionPublisher, choose_terms
from kuglice_server.schedule import Schedule
from kuglice_server.tick_loop import TickLoop

__all__ = ["Server", "ServerSettings"]

log = logging.getLogger(__name__)

HISTORY_SECONDS = 60
EARLIEST_SECONDS = 2
MAX_GRACE = 3600.0
WAITING_MESSAGES = 4096
EPOCH_ORIGIN = 1_767_225_600 * 10**9
"""The begin of 2026, in nanoseconds."""
EPOCH_SHIFT, EPOCHS = 28, 1 << 36
HASHED_BALLS = 100_000
"""Up to so many balls every state's hash is told."""


@dataclass(frozen=True)
class ServerSettings:
    """How a world is served; none of it changes its bits.

    `rate`: ticks per second of wall clock (None: the scene's). `snapshot_every`: ticks between published
    snapshots (None: a second's worth). `hash_every`: ticks between states whose hash is told (None: every one,
    or one per second where that would cost too much). `grace`: seconds for which a player whose link was cut
    keeps its ball. `region_rate`: times per second that views are told of what they
    look at. `threads`: how many share the work of a step. `insecure`:
    listen on addresses that others can reach, although there are no accounts and no encryption yet.
    """

    world: str
    listen: Sequence[str] = (DEFAULT_ENDPOINT,)
    connect: Sequence[str] = ()
    rate: float | None = None
    snapshot_every: int | None = None
    hash_every: int | None = None
    region_rate: float = 10.0
    record: Path | None = None
    grace: float = 10.0
    threads: int = 1
    insecure: bool = False

    def __post_init__(self) -> None:
        if not self.listen and not self.connect:
            raise ProtocolError("endpoints: none to listen on and none to connect to")
        if not self.insecure:
            refuse_exposed(self.listen)
        if self.snapshot_every is not None and self.snapshot_every < 1:
            raise ProtocolError(f"snapshot-every {self.snapshot_every}: must be at least 1 tick")
        if self.hash_every is not None and self.hash_every < 1:
            raise ProtocolError(f"hash-every {self.hash_every}: must be at least 1 tick")
        if not 0 < self.region_rate <= 1000:
            raise ProtocolError(
                f"region-rate {self.region_rate}: must be above 0 and at most 1000 times per second"
            )
        if not 0 <= self.grace <= MAX_GRACE:
            raise ProtocolError(f"grace {self.grace}: must be at least 0 and at most {MAX_GRACE:g} seconds")
        if self.rate is not None and not 0 < self.rate <= 10_000:
            raise ProtocolError(f"rate {self.rate}: must be above 0 and at most 10000 ticks per second")


class Server:
    """Serves `scene` from construction to `close()`; `run` makes its time pass. A context manager."""

    def __init__(self, scene: Scene, settings: ServerSettings) -> None:
        self.settings = settings
        self.world = World(scene, threads=settings.threads)
        self.epoch = _epoch()
        self.rate = settings.rate if settings.rate is not None else scene.tick_rate
        self.counters: Counter[str] = Counter()
        self._snapshot_every = settings.snapshot_every or max(1, round(self.rate))
        self._hash_every = settings.hash_every or (
            1 if self.world.count <= HASHED_BALLS else max(1, round(self.rate))
        )
        self._scene = scene
        # Who joins gets the balls of today, by a snapshot or region by region, and has no use for those of the start.
        self._ruled_scene_message = {**scene.to_message(), "balls": Balls.none().to_message()}
        self._lock = threading.Lock()
        self._players = Players(scene, grace=round(settings.grace * self.rate))
        intake = Intake(
            scene,
            self._players,
            epoch=self.epoch,
            horizon=max(1, round(EARLIEST_SECONDS * self.rate)),
            counters=self.counters,
        )
        self._history = History(span=max(600, round(HISTORY_SECONDS * self.rate)))
        self._schedule = Schedule(self.rate)
        self._record = Record(settings.record, self.world) if settings.record is not None else None
        keys = Keys(settings.world)
        self._session = open_session(server_configuration(listen=settings.listen, connect=settings.connect))
        publisher = Publisher(self._session, keys, epoch=self.epoch, rate=self.rate, counters=self.counters)
        region_every = max(1, round(self.rate / settings.region_rate))
        self._terms = choose_terms(self.world, rate=self.rate / region_every)
        self._reference_speed = reference_speed(scene)
        self._regions = RegionPublisher(
            self._session,
            keys,
            self._terms,
            epoch=self.epoch,
            world=self.world,
            every=region_every,
            counters=self.counters,
        )
        tokens: zenoh.Subscriber[Any] = self._session.liveliness().declare_subscriber(
            keys.clients, zenoh.handlers.RingChannel(WAITING_MESSAGES), history=True
        )
        inputs: zenoh.Subscriber[Any] = self._session.declare_subscriber(
            keys.inputs, zenoh.handlers.RingChannel(WAITING_MESSAGES)
        )
        self._loop = TickLoop(
            self.world,
            players=self._players,
            intake=intake,
            history=self._history,
            publisher=publisher,
            tokens=tokens,
            inputs=inputs,
            snapshot_every=self._snapshot_every,
            hash_every=self._hash_every,
            counters=self.counters,
            lock=self._lock,
            record=self._record,
        )
        self._now = self.world.tick
        self._balls = self.world.count
        answers = Answers(
            self._session,
            keys,
            epoch=self.epoch,
            about=self.about,
            view=self.view_about,
            status=self.status,
            history=self._history,
        )
        self._declared: tuple[Declared, ...] = (inputs, tokens, *answers.declared, *publisher.declared)

    def run(
        self,
        stop: threading.Event,
        *,
        seconds: float | None = None,
        until_empty: bool = False,
        each_tick: Callable[[Server], None] | None = None,
    ) -> None:
        """Tick until `stop`, for that many seconds of the schedule, or until the last client has left.

        A slow-down is logged, once per second at most.
        """
        self._schedule = Schedule(self.rate)
        ticks = None if seconds is None else round(seconds * self.rate)
        told_lost, told_at = 0.0, time.monotonic()
        while not stop.is_set() and (ticks is None or ticks > 0):
            self._schedule.wait(stop)
            if stop.is_set():
                break
            self._loop.tick()
            self._regions.turn(self.world)
            self._now, self._balls = self.world.tick, self.world.count
            ticks = None if ticks is None else ticks - 1
            if each_tick is not None:
                each_tick(self)
            if until_empty and self._deserted():
                log.info("the last client has left")
                break
            if self._schedule.seconds_lost > told_lost and time.monotonic() - told_at > 1:
                told_lost, told_at = self._schedule.seconds_lost, time.monotonic()
                log.warning("too slow for %g ticks per second: %.2f s lost so far", self.rate, told_lost)

    def _deserted(self) -> bool:
        with self._lock:
            return self._players.deserted

    def about(self) -> About:
        """What a client must know to join. Safe from any thread."""
        return About(
            **self._about_world(),
            snapshot_every=self._snapshot_every,
            hash_every=self._hash_every,
            history_ticks=self._history.span,
        )

    def view_about(self) -> ViewAbout:
        """What a view must know. Safe from any thread."""
        return ViewAbout(
            **self._about_world(),
            balls=self._balls,
            reference_speed=self._reference_speed,
            regions=self._terms,
        )

    def _about_world(self) -> dict[str, Any]:
        """The fields of AboutWorld."""
        return {
            "epoch": self.epoch,
            "world": self.settings.world,
            "version": __version__,
            "step_version": _core.STEP_VERSION,
            "scene": self._ruled_scene_message,
            "model": self.world.model.to_message(),
            "rate": self.rate,
            "tick": self._now,
        }

    def status(self) -> Status:
        """How it goes. Safe from any thread."""
        with self._lock:
            return Status(
                epoch=self.epoch,
                world=self.settings.world,
                tick=self._now,
                rate=self.rate,
                balls=self._balls,
                clients=self._players.status(),
                refusals=self._players.refusals(),
                counters={**self.counters, "late ticks": self._schedule.late_ticks},
                seconds_lost=self._schedule.seconds_lost,
                worst_lateness=self._schedule.worst_lateness,
            )

    def close(self, timeout: float = 5.0) -> bool:
        """Finish the record, leave the network. False if Zenoh did not finish within `timeout` seconds."""
        if self._record is not None:
            self._record.close()
        closed = close_session(self._session, (*self._declared, *self._regions.declared), timeout=timeout)
        if not closed:
            log.error("the network session did not close within %g s", timeout)
        return closed

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _epoch() -> int:
    """Grows from run to run, so that a restarted server never says an epoch again.

    No server starts twice within the 0.27 s that are one; a finer clock, or one that began earlier, would cost
    bytes in every message.
    """
    return (time.time_ns() - EPOCH_ORIGIN >> EPOCH_SHIFT) % EPOCHS
