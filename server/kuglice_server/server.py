"""The authority over one world: intake, tick loop, publishing and answering around one Zenoh session."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import zenoh

from kuglice import Balls, Scene, World, __version__, _core
from kuglice.closing import Closing
from kuglice.picture import reference_speed
from kuglice.protocol import (
    About,
    Declared,
    Keys,
    Status,
    ViewAbout,
    close_session,
    open_session,
    server_configuration,
)
from kuglice_server.answer import Answers
from kuglice_server.beside import Beside
from kuglice_server.counters import Counters
from kuglice_server.epoch import new_epoch
from kuglice_server.history import History
from kuglice_server.intake import Intake
from kuglice_server.players import Players
from kuglice_server.publish import Publisher
from kuglice_server.record import Record
from kuglice_server.regions import RegionPublisher, choose_terms
from kuglice_server.schedule import Schedule
from kuglice_server.settings import ServerSettings, check_rate
from kuglice_server.tick_loop import TickLoop

__all__ = ["Server"]

log = logging.getLogger(__name__)

HISTORY_SECONDS = 60
EARLIEST_SECONDS = 2
WAITING_MESSAGES = 4096
HASHED_BALLS = 100_000
"""Up to so many balls every state's hash is told."""


class Server(Closing):
    """Serves `scene` from construction to `close()`; `run` makes its time pass. A context manager."""

    def __init__(self, scene: Scene, settings: ServerSettings) -> None:
        self.settings = settings
        self.world = World(scene, threads=settings.threads)
        self.epoch = new_epoch()
        self.rate = (
            settings.rate
            if settings.rate is not None
            else check_rate("the scene's tick_rate", scene.tick_rate)
        )
        self.counters = Counters()
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
        region_every = max(1, round(self.rate / settings.region_rate))
        self._terms = choose_terms(self.world, rate=self.rate / region_every)
        self._reference_speed = reference_speed(scene)
        self._teller = Beside("regions")
        self._now = self.world.tick
        self._balls = self.world.count
        keys = Keys(settings.world)
        with ExitStack() as undo:
            self._session = open_session(
                server_configuration(listen=settings.listen, connect=settings.connect)
            )
            undo.callback(close_session, self._session, ())
            # Not before the address is ours: what is there already may be the recording of the server that has it.
            self._record = Record(settings.record, self.world) if settings.record is not None else None
            if self._record is not None:
                undo.callback(self._record.close)
            publisher = Publisher(
                self._session, keys, epoch=self.epoch, rate=self.rate, counters=self.counters
            )
            self._regions = RegionPublisher(
                self._session,
                keys,
                self._terms,
                epoch=self.epoch,
                world=self.world,
                every=region_every,
                counters=self.counters,
                teller=self._teller,
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
            self._answers = Answers(
                self._session,
                keys,
                epoch=self.epoch,
                hash_every=self._hash_every,
                about=self.about,
                view=self.view_about,
                status=self.status,
                settled=self._settled,
                history=self._history,
            )
            self._declared: tuple[Declared, ...] = (
                inputs,
                tokens,
                *self._answers.declared,
                *publisher.declared,
            )
            undo.pop_all()

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
            self._answers.ticked()
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

    def _settled(self, name: str, session: str) -> bool:
        with self._lock:
            return self._players.settled(name, session)

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
                counters={**self.counters.all(), "late_ticks": self._schedule.late_ticks},
                seconds_lost=self._schedule.seconds_lost,
                worst_lateness=self._schedule.worst_lateness,
            )

    def close(self, timeout: float = 5.0) -> bool:
        """Finish the record, leave the network. False if Zenoh did not finish within `timeout` seconds."""
        if self._record is not None:
            self._record.close()
        declared = (self._teller, *self._declared, *self._regions.declared)
        closed = close_session(self._session, declared, timeout=timeout)
        if not closed:
            log.error("the network session did not close within %g s", timeout)
        return closed
