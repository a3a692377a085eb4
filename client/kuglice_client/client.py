"""A headless client: joins, follows, predicts, acts, reconciles; one thread, and Zenoh's fill its rings."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import zenoh

from kuglice import World
from kuglice.errors import JoinError, ProtocolError
from kuglice.inputs import Input
from kuglice.protocol import (
    PART_BYTES,
    Assembly,
    Declared,
    History,
    Keys,
    Part,
    SnapshotRequest,
    Tick,
    TickRange,
    Whole,
    check_name,
    client_configuration,
    close_session,
    decode,
    encode,
    open_session,
)
from kuglice_client.ask import Asked
from kuglice_client.bots import BOTS, Sight
from kuglice_client.clock import Clock
from kuglice_client.follow import Follower
from kuglice_client.join import Joined, find_world, join
from kuglice_client.outbox import Outbox
from kuglice_client.prediction import Prediction
from kuglice_client.reconcile import Reconciler
from kuglice_client.totals import Figure, Totals
from kuglice_client.traffic import Traffic

if TYPE_CHECKING:
    from kuglice_client.render.moment import Moment

__all__ = ["Client", "ClientSettings"]

log = logging.getLogger(__name__)

Samples = zenoh.Subscriber[zenoh.handlers.Handler[zenoh.Sample]]

TICK_RING = 1024
PREDICTED_SECONDS = 0.5
BOT_SECONDS = 1 / 15
IDLE_SECONDS = 0.002
STALL_SECONDS = 2.0


@dataclass(frozen=True)
class ClientSettings:
    """`name`: who we are, None for a spectator. `bot`: an entry of BOTS that plays for us.

    `wait`: seconds to keep trying to join. `lose`: called with the number of each tick message; those for
    which it says True are thrown away on arrival, to see them heal.
    """

    connect: tuple[str, ...] = ("tcp/127.0.0.1:7447",)
    world: str | None = None
    name: str | None = None
    bot: str | None = None
    wait: float = 10.0
    lose: Callable[[int], bool] | None = None

    def __post_init__(self) -> None:
        if self.name is not None:
            check_name("client", self.name)
        if self.bot is not None and self.bot not in BOTS:
            raise ProtocolError(f"bot {self.bot!r}: there is none of that name, only {', '.join(BOTS)}")
        if self.bot is not None and self.name is None:
            raise ProtocolError(f"bot {self.bot!r}: needs a client name to play under")


class Client:
    """Connects and joins when made; `run` plays until told to stop. A context manager. Raises JoinError."""

    def __init__(self, settings: ClientSettings, stop: threading.Event | None = None) -> None:
        self.settings = settings
        self.stop = stop if stop is not None else threading.Event()
        self.traffic = Traffic()
        self.totals = Totals()
        self._declared: list[Declared] = []
        deadline = time.monotonic() + settings.wait
        self._session = _connect(settings, deadline, self.stop)
        try:
            world = settings.world or find_world(
                self._session, traffic=self.traffic, deadline=deadline, stop=self.stop
            )
            self._keys = Keys(world)
            self._ticks = self._subscribe(self._keys.tick, TICK_RING)
            self._snapshots = self._subscribe(self._keys.snapshot, 64)
            self._snapshot_ring = 64
            if settings.name is not None:
                self._declared.append(
                    self._session.liveliness().declare_token(self._keys.client(settings.name))
                )
            self._enter(self._join(deadline))
        except BaseException:
            self.close()
            raise
        self.joined_after = time.monotonic() - deadline + settings.wait
        self._began = time.monotonic()

    @property
    def confirmed(self) -> World:
        """The world as the server has it."""
        return self.follower.world

    @property
    def own(self) -> int | None:
        """Id of one's own ball, once it exists."""
        return None if self.outbox is None else dict(self.prediction.world.players).get(self.outbox.number)

    def act(self, given: Input) -> None:
        """Do something at the next tick that is predicted; client and sequence number are filled in here.

        Raises JoinError for a spectator, and when too much is unacknowledged to add more.
        """
        if self.outbox is None:
            raise JoinError("a spectator cannot act: join with a name")
        if self.outbox.full:
            raise JoinError("too many inputs are unacknowledged: the server does not answer")
        tick = self.prediction.world.tick
        self.prediction.act(self.outbox.add(given, tick), tick)

    def turn(self, now: float) -> float:
        """Take in what came, predict up to now, send.

        Returns how far the drawn state is from one tick to the next.
        """
        self._receive(now)
        self._heal()
        target = self.clock.target(now)
        while self.prediction.world.tick < math.floor(target) and self.prediction.may_step(self.confirmed):
            self._let_bot_act()
            self.prediction.step()
        self._send(now)
        return max(0.0, min(1.0, target - self.prediction.world.tick))

    def run(
        self,
        *,
        seconds: float | None = None,
        fps: float | None = None,
        each_frame: Callable[[Client, float], None] | None = None,
    ) -> None:
        """Play until `stop`, or for that long.

        `each_frame` gets the client and alpha, `fps` times per second.
        """
        begin = time.monotonic()
        frames = 0
        while not self.stop.is_set():
            now = time.monotonic()
            if seconds is not None and now - begin >= seconds:
                break
            alpha = self.turn(now)
            while fps is not None and each_frame is not None and now - begin >= frames / fps:
                each_frame(self, alpha)
                frames += 1
            self.stop.wait(IDLE_SECONDS)

    def summary(self) -> dict[str, Any]:
        """What this session was like, as values for JSON.

        `agreed`: every hash and every snapshot was the server's.
        """
        seconds = time.monotonic() - self._began
        figures = self.totals.with_past(self._figures())
        rates = self.traffic.per_second(seconds)
        return {
            "name": self.settings.name,
            "number": self.joined.number,
            "world": self._keys.world,
            "epoch": self.epoch,
            "seconds": seconds,
            "joined_after_seconds": self.joined_after,
            "final_tick": self.confirmed.tick,
            "final_hash": f"{self.confirmed.state_hash:016x}",
            "agreed": figures["hashes_checked"] > 0
            and figures["hash_mismatches"] == 0
            and figures["snapshot_mismatches"] == 0,
            **figures,
            "messages_thrown_away": self.totals.messages_thrown_away,
            "malformed_messages": self.totals.malformed_messages,
            "gaps_skipped": self.totals.gaps_skipped,
            "rejoins": self.totals.rejoins,
            "lead_ticks": self.clock.lead,
            "bytes_per_second_received": rates["received"],
            "bytes_per_second_ticks": rates.get("ticks", 0.0),
            "bytes_per_second_snapshots": rates.get("snapshots", 0.0),
            "bytes_per_second_sent": rates["sent"],
            "bytes_joining": self.traffic.received["joining"],
        }

    def _figures(self) -> dict[str, Figure]:
        outbox = self.outbox
        return {
            "hashes_checked": self.reconciler.hashes_checked,
            "hash_mismatches": self.reconciler.hash_mismatches,
            "snapshots_checked": self.reconciler.snapshots_checked,
            "snapshot_mismatches": self.reconciler.snapshot_mismatches,
            "snapshots_taken": self.reconciler.snapshots_taken,
            "snapshots_too_old": self.reconciler.snapshots_too_old,
            "inputs_accepted": 0 if outbox is None else outbox.accepted,
            "inputs_refused": 0 if outbox is None else outbox.refused,
            "inputs_late": 0 if outbox is None else outbox.late,
            "rollbacks": self.prediction.rollbacks,
            "deepest_rollback": self.prediction.deepest_rollback,
            "ticks_rerun": self.prediction.ticks_rerun,
            "worst_correction_radii": self.prediction.worst_correction,
            "messages_missed": self.follower.missed_messages,
            "ticks_healed_by_repeats": self.follower.healed_by_repeats,
            "ticks_healed_by_history": self.follower.healed_by_history,
        }

    def moment(self, alpha: float, *, nodes: bool = False) -> Moment:
        """What is to be seen: `alpha` of the way from the last but one predicted state to the last."""
        from kuglice_client.interpolation import interpolate  # noqa: PLC0415 - the extra `render`
        from kuglice_client.render.moment import HashState  # noqa: PLC0415 - the extra `render`

        wrong = self.reconciler.wrong_since is not None
        state = HashState(self.confirmed.state_hash, self.confirmed.tick, "different" if wrong else "equal")
        return interpolate(self.prediction.previous, self.prediction.world, alpha, state, nodes=nodes)

    def close(self, timeout: float = 5.0) -> bool:
        """Leave. False if Zenoh did not finish within `timeout` seconds."""
        return close_session(self._session, reversed(self._declared), timeout=timeout)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _subscribe(self, key: str, ring: int) -> Samples:
        subscriber = self._session.declare_subscriber(key, zenoh.handlers.RingChannel(ring))
        self._declared.append(subscriber)
        return subscriber

    def _join(self, deadline: float) -> Joined:
        return join(
            self._session,
            self._keys,
            self.settings.name,
            traffic=self.traffic,
            deadline=deadline,
            stop=self.stop,
        )

    def _enter(self, joined: Joined) -> None:
        """Begin in a world that was just joined, for the first time or after a restart of the server."""
        now = time.monotonic()
        about = joined.about
        self.joined = joined
        self.epoch = joined.epoch
        self.follower = Follower(joined.world)
        self.reconciler = Reconciler(self.follower, snapshot_every=about.snapshot_every)
        self.prediction = Prediction(joined.world, limit=max(4, round(PREDICTED_SECONDS * about.rate)))
        self.clock = Clock(rate=about.rate, tick=about.tick, now=now, round_trip=joined.round_trip)
        self.outbox = (
            None
            if joined.number is None
            else Outbox(
                epoch=joined.epoch,
                number=joined.number,
                sequence=joined.sequence,
                resend_seconds=max(0.1, 2 * joined.round_trip),
            )
        )
        self._assembly = Assembly()
        self._asked: Asked | None = None
        self._asked_snapshot = False
        self._heard_at = now
        self._stalled = False
        self._bot_at = 0
        self._bot_said: Input | None = None
        parts = len(joined.world.snapshot()) // PART_BYTES + 2
        if 3 * parts > self._snapshot_ring:
            # The ring must hold a whole snapshot and the begin of the next, or no snapshot is ever complete.
            self._snapshots.undeclare()  # type: ignore[no-untyped-call]
            self._declared.remove(self._snapshots)
            self._snapshot_ring = 3 * parts
            self._snapshots = self._subscribe(self._keys.snapshot, self._snapshot_ring)
        log.info("joined world %s at tick %d%s", about.world, joined.world.tick, _as_whom(joined))

    def _receive(self, now: float) -> None:
        while (sample := self._ticks.try_recv()) is not None:
            data = sample.payload.to_bytes()
            self.traffic.received["ticks"] += len(data)
            try:
                message = decode(data, Tick)
            except ProtocolError as error:
                self._malformed("tick", error)
                continue
            if message.epoch != self.epoch:
                if message.epoch > self.epoch:
                    self._rejoin()
                continue
            if self.settings.lose is not None and self.settings.lose(message.end - 1):
                self.totals.messages_thrown_away += 1
                continue
            self._heard(message, now)
        while (sample := self._snapshots.try_recv()) is not None:
            data = sample.payload.to_bytes()
            self.traffic.received["snapshots"] += len(data)
            try:
                part = decode(data, Part)
                whole = self._assembly.add(part) if part.epoch == self.epoch else None
            except ProtocolError as error:
                self._malformed("snapshot", error)
                continue
            if whole is not None and self.reconciler.received(whole):
                self.prediction.distrust()
        if now - self._heard_at > STALL_SECONDS and not self._stalled:
            self._stalled = True
            log.warning("no news of world %s for %g s", self._keys.world, STALL_SECONDS)

    def _heard(self, message: Tick, now: float) -> None:
        self._heard_at, self._stalled = now, False
        self.clock.heard(message.end, now)
        for ack in message.acks:
            pending = None if self.outbox is None else self.outbox.resolve(ack)
            if pending is None:
                continue
            self.prediction.settle(pending.given, pending.tick, ack.tick)
            self.clock.reported(ack.early)
            if ack.refused is not None:
                log.warning("refused: %s", ack.refused)
        self.follower.take(message)
        self._confirm()

    def _confirm(self) -> None:
        for step in self.follower.advance():
            self.prediction.confirm(step.entry)
            self.reconciler.confirmed(step)
            if self.reconciler.compare_waiting():
                self.prediction.distrust()
                break
        self.prediction.reconcile(self.confirmed)

    def _heal(self) -> None:
        """Ask for what the stream did not bring, one question at a time."""
        if self._asked is not None:
            self._hear_answer()
        if self._asked is not None:
            return
        if self.reconciler.wrong_since is not None or self._asked_snapshot:
            self._ask(SnapshotRequest(epoch=self.epoch, at=None))
        elif (gap := self.follower.gap) is not None:
            self._ask(TickRange(epoch=self.epoch, first=gap[0], end=gap[1]))

    def _ask(self, request: SnapshotRequest | TickRange) -> None:
        self._asked_snapshot = isinstance(request, SnapshotRequest)
        self._asked = Asked(self._session, self._keys.history, request, traffic=self.traffic)

    def _hear_answer(self) -> None:
        assert self._asked is not None
        try:
            whole = self._asked.poll_whole()
            if whole is None:
                return
            self._asked = None
            if whole.of == "history":
                self.follower.take(decode(whole.data, History), from_history=True)
                # What the history does not reach back to any more can only be skipped with a snapshot.
                self._asked_snapshot = self.follower.gap is not None
                self._confirm()
            else:
                self._asked_snapshot = False
                self._take_snapshot(whole)
        except (JoinError, ProtocolError) as error:
            self._asked = None
            self._asked_snapshot = True
            log.warning("%s", error)

    def _take_snapshot(self, whole: Whole) -> None:
        if self.follower.gap is not None and whole.tick > self.confirmed.tick:
            self.reconciler.stranded(whole)
            self.totals.gaps_skipped += 1
        elif not self.reconciler.received(whole):
            return
        self.prediction.distrust()
        self._confirm()

    def _let_bot_act(self) -> None:
        world = self.prediction.world
        if self.settings.bot is None or self.outbox is None or world.tick < self._bot_at or self.outbox.full:
            return
        self._bot_at = world.tick + max(1, round(BOT_SECONDS * self.joined.about.rate))
        given = BOTS[self.settings.bot](Sight(world, self.own))
        # Inputs are held until changed: saying the same again would only cost bytes.
        if given is not None and given != self._bot_said:
            self._bot_said = given
            self.act(given)

    def _send(self, now: float) -> None:
        message = None if self.outbox is None else self.outbox.message(now)
        if message is None or self.settings.name is None:
            return
        data = encode(message)
        self.traffic.sent["inputs"] += len(data)
        self._session.put(
            self._keys.input(self.settings.name),
            data,
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.INTERACTIVE_HIGH,
            express=True,
            allowed_destination=zenoh.Locality.REMOTE,
        )

    def _rejoin(self) -> None:
        log.warning("world %s was restarted: joining again", self._keys.world)
        self.totals.keep(self._figures())
        self.totals.rejoins += 1
        self._enter(self._join(time.monotonic() + self.settings.wait))

    def _malformed(self, what: str, error: ProtocolError) -> None:
        self.totals.malformed_messages += 1
        if self.totals.malformed_messages == 1:
            log.warning("%s: %s (further ones are only counted)", what, error)


def _as_whom(joined: Joined) -> str:
    return " as a spectator" if joined.number is None else f" as client {joined.number}"


def _connect(settings: ClientSettings, deadline: float, stop: threading.Event) -> zenoh.Session:
    while True:
        try:
            return open_session(client_configuration(settings.connect, timeout=1.0))
        except ProtocolError as error:
            if time.monotonic() > deadline or stop.is_set():
                raise JoinError(str(error)) from error
