"""The authority over one world: intake, tick loop, publishing and answering around one Zenoh session."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import zenoh

from kuglice import Scene, World
from kuglice.closing import Closing
from kuglice.inputs import Input
from kuglice.protocol import (
    About,
    Admission,
    Declared,
    Keys,
    Status,
    UnreadDatagrams,
    ViewAbout,
    close_session,
    open_session,
    server_configuration,
)
from kuglice_server.answer import Answers
from kuglice_server.beside import Beside
from kuglice_server.cadence import Cadence
from kuglice_server.counters import Counters
from kuglice_server.description import Description
from kuglice_server.ending import Ending
from kuglice_server.epoch import new_epoch
from kuglice_server.history import History
from kuglice_server.inboxes import Inboxes
from kuglice_server.intake import Intake
from kuglice_server.owner import Owner
from kuglice_server.players import Players
from kuglice_server.publish import Publisher
from kuglice_server.record import Record
from kuglice_server.regions import RegionPublisher, choose_terms
from kuglice_server.rival import refuse_rival
from kuglice_server.schedule import Schedule
from kuglice_server.settings import ServerSettings
from kuglice_server.tick_loop import TickLoop

__all__ = ["Server"]

log = logging.getLogger(__name__)

Samples = zenoh.Subscriber[Any]

WAITING_MESSAGES = 4096


class Server(Closing):
    """Serves `scene` from construction to `close()`; `run` makes its time pass. A context manager."""

    def __init__(self, scene: Scene, settings: ServerSettings) -> None:
        self.settings = settings
        self.world = World(scene, threads=settings.threads)
        self.epoch = new_epoch()
        self.cadence = Cadence.of(settings, self.world)
        self.counters = Counters()
        self._keys = Keys(settings.world)
        self._lock = threading.Lock()
        self._closed = threading.Event()
        # Held while ticks are made. The thread that has it may take it again: rules of a game may close their server.
        self._making_ticks = threading.RLock()
        self._cut_short = False
        self._owner = Owner(self.world, self.counters)
        self._players = Players(scene, grace=self.cadence.grace, counters=self.counters)
        self._history = History(span=self.cadence.history)
        self._schedule = Schedule(self.cadence.rate)
        self._terms = choose_terms(self.world, rate=self.cadence.region_rate)
        self._description = Description(
            settings.world, self.world, epoch=self.epoch, cadence=self.cadence, terms=self._terms
        )
        self._teller = Beside("regions")
        self._now = self.world.tick
        self._balls = self.world.count
        with ExitStack() as undo:
            self._session = open_session(
                server_configuration(listen=settings.listen, connect=settings.connect, keys=self._keys)
            )
            undo.callback(close_session, self._session, ())
            if settings.connect:
                refuse_rival(self._keys, settings.connect)
            # Not before the address is ours: what is there already may be the recording of the server that has it.
            self._record = Record(settings.record, self.world) if settings.record is not None else None
            if self._record is not None:
                undo.callback(self._record.close)
            self._publisher = self._make_publisher()
            self._regions = self._make_regions()
            self._tokens = self._subscribe()
            self._inboxes = Inboxes(self._session, self._keys, counters=self.counters)
            self._loop = self._make_loop()
            self._answers = self._make_answers()
            self._unread = UnreadDatagrams(settings.listen)
            undo.pop_all()

    def _make_publisher(self) -> Publisher:
        return Publisher(
            self._session, self._keys, epoch=self.epoch, rate=self.cadence.rate, counters=self.counters
        )

    def _make_regions(self) -> RegionPublisher:
        return RegionPublisher(
            self._session,
            self._keys,
            self._terms,
            epoch=self.epoch,
            world=self.world,
            every=self.cadence.region_every,
            counters=self.counters,
            teller=self._teller,
        )

    def _subscribe(self) -> Samples:
        """To who is there."""
        return self._session.liveliness().declare_subscriber(
            self._keys.clients, zenoh.handlers.RingChannel(WAITING_MESSAGES), history=True
        )

    def _make_loop(self) -> TickLoop:
        return TickLoop(
            self.world,
            owner=self._owner,
            players=self._players,
            intake=Intake(
                self.world.scene,
                self._players,
                epoch=self.epoch,
                horizon=self.cadence.horizon,
                counters=self.counters,
            ),
            history=self._history,
            publisher=self._publisher,
            tokens=self._tokens,
            inboxes=self._inboxes,
            snapshot_every=self.cadence.snapshot_every,
            hash_every=self.cadence.hash_every,
            counters=self.counters,
            lock=self._lock,
            record=self._record,
        )

    def _make_answers(self) -> Answers:
        return Answers(
            self._session,
            self._keys,
            epoch=self.epoch,
            hash_every=self.cadence.hash_every,
            about=self.about,
            view=self.view_about,
            status=self.status,
            settled=self._settled,
            admission=self._admission,
            history=self._history,
        )

    def act(self, given: Input) -> Input:
        """Let the world's owner do something in the next tick: spawn, remove, kick or attract, as rules of a game do.

        The owner (client 0) is held to what is possible, not to the scene's limits. Its place is `each_tick` of `run`,
        where the world stands still to be looked at. Returns the input as it will act.

        Raises InputError for what is impossible now. What turns out so in its tick only (a spawn where a ball has
        moved to) is left out, logged and counted.
        """
        return self._owner.act(given)

    def dismiss(self, name: str, reason: str) -> None:
        """Take a player out of the game in the next tick, ball and all. Safe from any thread.

        Its client is told `reason` when it next asks how it stands, within about two seconds, and ends with a
        JoinError that says it. That session does not come back. The same person may, in a session of its own: keeping
        somebody out is for the rules of the game, which see in `status().clients` who plays.

        Raises InputError if nobody plays under that name, or for a reason that is empty or longer than a client can
        be told.
        """
        with self._lock:
            self._players.dismiss(name, reason)

    def run(
        self,
        stop: threading.Event,
        *,
        seconds: float | None = None,
        until_empty: bool = False,
        each_tick: Callable[[Server], None] | None = None,
    ) -> None:
        """Tick until `stop`, for that many seconds of the schedule, or until the last client has left.

        `each_tick` is called between two ticks, to look at the world and to `act`; what it takes, the ticks wait for.
        A slow-down is logged, once per second at most. `close` ends it too, from any thread; a server that is closed
        makes no more ticks. Raises StepError if anybody else steps the world.
        """
        with self._making_ticks:
            try:
                self._make_ticks(Ending(stop, self._closed), seconds, until_empty, each_tick)
            except (zenoh.ZError, RuntimeError) as error:
                if not self._cut_short:
                    raise
                log.warning("tick %d was cut short: %s", self.world.tick, error)
            finally:
                if self._closed.is_set():
                    self._end_record()

    def _make_ticks(
        self,
        ending: Ending,
        seconds: float | None,
        until_empty: bool,
        each_tick: Callable[[Server], None] | None,
    ) -> None:
        self._schedule = Schedule(self.cadence.rate)
        ticks = None if seconds is None else round(seconds * self.cadence.rate)
        told_lost, told_at = 0.0, time.monotonic()
        while not ending.is_set() and (ticks is None or ticks > 0):
            self._schedule.wait(ending)
            if ending.is_set():
                break
            self._loop.tick()
            self._regions.turn(self.world)
            self._now, self._balls = self.world.tick, self.world.count
            self._answers.ticked()
            self._unread.turn()
            ticks = None if ticks is None else ticks - 1
            if each_tick is not None:
                each_tick(self)
            if until_empty and self._deserted():
                log.info("the last client has left")
                break
            if self._schedule.seconds_lost > told_lost and time.monotonic() - told_at > 1:
                told_lost, told_at = self._schedule.seconds_lost, time.monotonic()
                log.warning(
                    "too slow for %g ticks per second: %.2f s lost so far", self.cadence.rate, told_lost
                )

    def _deserted(self) -> bool:
        with self._lock:
            return self._players.deserted

    def _settled(self, name: str, session: str) -> bool:
        with self._lock:
            return self._players.settled(name, session)

    def _admission(self, name: str, session: str) -> Admission:
        with self._lock:
            return self._players.admission(name, session, epoch=self.epoch)

    def about(self) -> About:
        """What a client must know to join. Safe from any thread."""
        return self._description.about(tick=self._now)

    def view_about(self) -> ViewAbout:
        """What a view must know. Safe from any thread."""
        return self._description.view_about(tick=self._now, balls=self._balls)

    def status(self) -> Status:
        """How it goes. Safe from any thread."""
        with self._lock:
            return Status(
                epoch=self.epoch,
                world=self.settings.world,
                tick=self._now,
                rate=self.cadence.rate,
                balls=self._balls,
                clients=self._players.status(),
                counters={**self.counters.all(), "late_ticks": self._schedule.late_ticks},
                seconds_lost=self._schedule.seconds_lost,
                worst_lateness=self._schedule.worst_lateness,
            )

    def close(self, timeout: float = 5.0) -> bool:
        """End `run` after the tick under way, finish the record, leave the network. Safe from any thread, and in
        `each_tick`.

        False if that took longer than `timeout` seconds: Zenoh did not finish, or the tick, which then tells nobody of
        itself and ends the record when it is done.
        """
        self._closed.set()
        until = time.monotonic() + timeout
        if not self._making_ticks.acquire(timeout=timeout):
            log.error("tick %d did not end within %g s", self._now, timeout)
            self._cut_short = True
            self._leave(0.0)
            return False
        try:
            self._end_record()
            return self._leave(max(0.0, until - time.monotonic()))
        finally:
            self._making_ticks.release()

    def _end_record(self) -> None:
        if self._record is not None:
            self._record.close()

    def _leave(self, timeout: float) -> bool:
        declared: tuple[Declared, ...] = (
            self._teller,
            self._inboxes,
            self._tokens,
            *self._answers.declared,
            *self._publisher.declared,
            *self._regions.declared,
        )
        closed = close_session(self._session, declared, timeout=timeout)
        if not closed:
            log.error("the network session did not close in time")
        return closed
