"""A headless client: joins, follows, predicts, acts, reconciles; one thread, and Zenoh's fill its rings."""

from __future__ import annotations

import logging
import math
import secrets
import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Self

from kuglice import World
from kuglice.errors import JoinError, ProtocolError
from kuglice.inputs import Input, rounded
from kuglice.protocol import PART_BYTES, Ack, Assembly, History, Keys, Tick
from kuglice.study.recorder import StudyRecorder
from kuglice_client.autopilot import Autopilot
from kuglice_client.bots import Sight
from kuglice_client.clock import Clock
from kuglice_client.datagram_watch import DatagramWatch
from kuglice_client.follow import Follower
from kuglice_client.healing import Healing
from kuglice_client.join import Joined, find_world, join
from kuglice_client.link import Link
from kuglice_client.outbox import Outbox
from kuglice_client.pace import judge_pace, step_seconds
from kuglice_client.pinging import Pinging
from kuglice_client.prediction import Floats, Ids, Prediction
from kuglice_client.reconcile import Reconciler
from kuglice_client.renewal import Renewal
from kuglice_client.run_loop import Frames, run_loop
from kuglice_client.screen import Screen
from kuglice_client.settings import ClientSettings
from kuglice_client.summary import figures, summarise
from kuglice_client.totals import Totals

if TYPE_CHECKING:
    from kuglice_client.render.moment import Moment

__all__ = ["Client"]

log = logging.getLogger(__name__)

PREDICTED_SECONDS = 1.5
STALL_SECONDS = 2.0
SILENCE_SECONDS = 0.5
SILENCE_TICKS = 4
LAG_SECONDS = 2.0
LINGER_TRIPS = 1.5
"""Round trips for which a goodbye is given time to arrive."""
CONFIRM_SECONDS = 0.05
PREDICT_SECONDS = 0.012
"""Of one turn: running forward again that takes longer goes on in the next, and frames come in between."""
SNAPSHOT_BYTES_PER_BALL = 64
KNOWN_EPOCHS = 64
SESSION_BYTES = 8


class Client:
    """Connects and joins when made; `run` plays until told to stop. A context manager. Raises JoinError."""

    def __init__(self, settings: ClientSettings, stop: threading.Event | None = None) -> None:
        began = time.monotonic()
        deadline = began + settings.wait
        self.settings = settings
        self.stop = stop if stop is not None else threading.Event()
        self.totals = Totals()
        self.screen = Screen()
        self._study: StudyRecorder | None = None
        self._linger = 0.0
        # Tells us from another who takes the same name; whoever is cut off and comes back is the same still.
        self._session = secrets.token_hex(SESSION_BYTES)
        self.link = Link(settings.connect, deadline=deadline, stop=self.stop, renewable=True)
        self._datagrams = DatagramWatch(self.link)
        self.renewal = Renewal(self.link, self._datagrams)
        try:
            self._study = None if settings.study is None else StudyRecorder(settings.study)
            world = settings.world or find_world(self.link, deadline=deadline, stop=self.stop)
            self._keys = Keys(world)
            # First the stream, then the rest: what happens while we join is in its buffer.
            self.link.listen(self._keys, snapshots=settings.check_snapshots)
            if settings.name is not None:
                self.link.show(settings.name, self._session)
            self._other_epochs: set[int] = set()
            self._enter(self._join(deadline))
        except BaseException:
            self.close()
            raise
        self._joined_at = time.monotonic()
        self.joined_after = self._joined_at - began

    @property
    def confirmed(self) -> World:
        """The world as the server has it."""
        return self.follower.world

    @property
    def epoch(self) -> int:
        """The run of the server that we are in."""
        return self.joined.epoch

    @property
    def own(self) -> int | None:
        """Id of one's own ball, once it exists."""
        return None if self.outbox is None else dict(self.prediction.shown[1].players).get(self.outbox.number)

    def act(self, given: Input) -> None:
        """Do something at the next tick that is predicted, or `input_delay` ticks later.

        Client and sequence number are filled in here.

        Raises JoinError for a spectator, and when too much is unacknowledged to add more.
        """
        if self.outbox is None:
            raise JoinError("a spectator cannot act: join with a name")
        if self.outbox.full:
            raise JoinError("too many inputs are unacknowledged: the server does not answer")
        if not self.settings.exact_inputs:
            given = rounded(given, self.joined.scene)
        now = time.monotonic()
        tick = self._acting_tick(now) + self.settings.input_delay
        mine = self.outbox.add(given, tick, lead=self.clock.lead, made=now)
        self.prediction.act(mine, tick)
        if self._study is not None:
            self._study.acted(now, mine, tick)
        self.screen.feel.acted(mine.sequence, tick, now)

    def turn(self, now: float) -> float:
        """Take in what came, predict up to now, send. `frame` is to be called for each frame that is drawn of it.

        Returns how far the drawn state is from one tick to the next.
        """
        self._receive(now)
        self._datagrams.turn(now)
        silent = now - self._heard_at > self._silence
        if self.healing.turn(now, silent=silent):
            self._replaced(now)
        self.renewal.turn(now, silent=silent, answered=self.healing.brought is not None)
        if self.healing.brought is not None:
            self._brought(self.healing.brought, now)
        round_trip = self._pinging.turn(now, self.confirmed.tick - 1)
        if round_trip is not None:
            self.clock.answered(round_trip)
        target = self.clock.target(now)
        # Who has not even confirmed what is known has no time for guesses.
        confirmed = self._confirm(now)
        self._predict(math.floor(target), now, step=confirmed)
        if self.outbox is not None:
            message = self.outbox.message(now, self.confirmed.tick)
            if message is not None:
                self.link.send(message)
        self.screen.alpha = max(0.0, min(1.0, target - self.prediction.shown[1].tick))
        return self.screen.alpha

    def frame(self, now: float) -> None:
        """A frame is drawn: what can be seen in it is counted."""
        self.screen.frame(now, self.prediction)
        if self._study is not None:
            self._study.frame(
                now, self.prediction.shown[1], self.screen.alpha, self.confirmed.tick, self._seen
            )

    def run(
        self,
        *,
        seconds: float | None = None,
        fps: float | None = None,
        each_frame: Callable[[Client, float], None] | None = None,
    ) -> None:
        """Play until `stop`, or for that long.

        `each_frame` gets the client and alpha, `fps` times per second: a film leaves no frame out. Without `fps`
        it is as on a screen, which does.
        """

        def frame(alpha: float) -> None:
            self.frame(time.monotonic())
            if each_frame is not None:
                each_frame(self, alpha)

        run_loop(self.turn, frame, Frames(fps), stop=self.stop, seconds=seconds)

    def summary(self) -> dict[str, Any]:
        """What this session was like, as values for JSON."""
        return summarise(self, seconds=time.monotonic() - self._joined_at)

    def moment(self, alpha: float, *, nodes: bool = False) -> Moment:
        """What is to be seen: `alpha` of the way from the last but one predicted state to the last."""
        from kuglice_client.interpolation import interpolate  # noqa: PLC0415 - the extra `render`
        from kuglice_client.render.moment import HashState  # noqa: PLC0415 - the extra `render`

        wrong = self.reconciler.wrong_since is not None
        state = HashState(self.confirmed.state_hash, self.confirmed.tick, "different" if wrong else "equal")
        moment = interpolate(*self.prediction.shown, alpha, state, nodes=nodes)
        return replace(moment, position=self.screen.seen(moment.id, moment.position))

    def close(self, timeout: float = 5.0) -> bool:
        """Leave. False if Zenoh did not finish within `timeout` seconds."""
        if self._study is not None:
            self._study.close()
        return self.link.close(timeout, linger=self._linger)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _join(self, deadline: float) -> Joined:
        who = None if self.settings.name is None else (self.settings.name, self._session)
        return join(self.link, self._keys, who, deadline=deadline, stop=self.stop)

    def _enter(self, joined: Joined) -> None:
        """Begin in a world that was just joined, for the first time or after a restart of the server."""
        about = joined.about
        self.step_seconds = step_seconds(joined.world)
        judge_pace(self.step_seconds, rate=about.rate, balls=joined.world.count)
        now = time.monotonic()
        self.joined = joined
        self._linger = LINGER_TRIPS * joined.round_trip
        self.follower = Follower(joined.world)
        self.reconciler = Reconciler(
            self.follower,
            snapshot_every=about.snapshot_every if self.settings.check_snapshots else None,
            reports=self.settings.desync_reports,
            step_version=about.step_version,
        )
        self.prediction = Prediction(joined.world, limit=max(4, round(PREDICTED_SECONDS * about.rate)))
        self.clock = Clock(
            rate=about.rate,
            tick=about.tick,
            now=now,
            round_trip=joined.round_trip,
            input_delay=self.settings.input_delay,
            in_order="udp" not in self.link.kinds,
        )
        self._pinging = Pinging(self.link, self._keys, epoch=joined.epoch, now=now)
        self.screen.entered()
        self.healing = Healing(
            self.link, self._keys, epoch=joined.epoch, follower=self.follower, reconciler=self.reconciler
        )
        self.outbox = (
            None
            if joined.number is None
            else Outbox(
                epoch=joined.epoch,
                number=joined.number,
                sequence=joined.sequence,
                tick_seconds=1 / about.rate,
                resend_seconds=max(0.1, 2 * joined.round_trip),
            )
        )
        if self._study is not None:
            self._study.joined(
                now,
                joined.world,
                name=self.settings.name,
                number=joined.number,
                epoch=joined.epoch,
                rate=about.rate,
            )
        self._assembly = Assembly()
        self._heard_at = now
        self._silence = max(SILENCE_SECONDS, SILENCE_TICKS / about.rate)
        self._stalled = False
        self._lagging = False
        bot = self.settings.bot
        self._autopilot = None if bot is None else Autopilot(bot, rate=about.rate)
        # The ring must hold a whole snapshot and the begin of the next, also when there will be more balls.
        balls = max(joined.world.count, joined.scene.limits.max_balls)
        self.link.make_room(3 * (SNAPSHOT_BYTES_PER_BALL * balls // PART_BYTES + 1))
        whom = "a spectator" if joined.number is None else f"client {joined.number}"
        log.info("joined world %s at tick %d as %s", about.world, joined.world.tick, whom)

    def _receive(self, now: float) -> None:
        # Snapshots first: one that is ahead waits for its tick, one that is far behind cannot be compared.
        for part in self.link.snapshot_parts():
            try:
                whole = self._assembly.add(part) if part.epoch == self.epoch else None
            except ProtocolError as error:
                self.totals.malformed_snapshots += 1
                log.warning("%s", error)
                continue
            if whole is not None and self.reconciler.received(whole):
                self._replaced(now)
        for message in self.link.ticks():
            if message.epoch != self.epoch:
                if message.epoch not in self._other_epochs:
                    self._rejoin(message.epoch)
            elif self.settings.lose is not None and self.settings.lose(message.end - 1):
                self.totals.messages_thrown_away += 1
            else:
                self._heard(message, now)
        if now - self._heard_at > STALL_SECONDS and not self._stalled:
            self._stalled = True
            log.warning("no news of world %s for %g s", self._keys.world, STALL_SECONDS)

    def _heard(self, message: Tick, now: float) -> None:
        self._heard_at, self._stalled = now, False
        self.screen.feel.heard(now)
        self.clock.heard(message.end, now)
        if self.outbox is not None:
            self._answered(message.outcomes(self.outbox.number), self.outbox)
        self.follower.take(message)

    def _brought(self, history: History, now: float) -> None:
        """Ticks from the history stand in for a stream that has stopped."""
        if self.outbox is not None:
            self._answered(history.acting(self.outbox.number), self.outbox)
        if now - self._heard_at > self._silence:
            self.clock.heard(history.end, now)
            self.screen.feel.heard(now)

    def _answered(self, outcomes: Iterable[Ack], outbox: Outbox) -> None:
        for ack in outcomes:
            pending = outbox.resolve(ack)
            if pending is None:
                continue
            self.prediction.settle(pending.given, pending.tick, ack.tick)
            early = pending.early(ack)
            if self._study is not None:
                self._study.answered(self._heard_at, pending.given.sequence, ack.tick, early)
            if early is not None:
                self.clock.reported(early, lead=pending.lead, made=pending.made)
            if ack.refused is not None:
                log.warning("refused: %s", ack.refused)

    def _seen(self) -> tuple[Ids, Floats]:
        """Ids and positions of the balls of the last frame."""
        ids, position = self.prediction.drawn(self.screen.alpha)
        return ids, self.screen.seen(ids, position)

    def _confirm(self, now: float) -> bool:
        """Step through what is known, or, if that is much, through some of it. Whether that was all."""
        done = True
        for step in self.follower.advance():
            self.prediction.confirm(step.entry)
            self.reconciler.confirmed(step)
            if self._study is not None:
                self._study.tick(now, step.entry.tick, step.entry.inputs, step.entry.state_hash)
            if self.reconciler.compare_waiting():
                self._replaced(now)
                break
            if time.monotonic() - now > CONFIRM_SECONDS:
                done = False
                break
        if self.follower.behind == 0:
            self.screen.feel.caught_up(time.monotonic())
        self._note_lag()
        return done

    def _predict(self, tick: int, now: float, *, step: bool) -> None:
        """Run forward again what was wrong, then on to `tick` if there is time to `step`.

        What is too much for this turn waits for the next.
        """
        prediction = self.prediction
        until = time.monotonic() + PREDICT_SECONDS

        def in_time() -> bool:
            return time.monotonic() < until

        reached = prediction.world.tick
        if prediction.reconcile(self.confirmed, in_time) and self._study is not None:
            self._study.rollback(now, self.confirmed.tick, reached)
        self._switch(now)
        if tick > prediction.shown[1].tick:
            self._let_bot_act(now)
        while step and prediction.world.tick < tick and in_time() and prediction.may_step(self.confirmed):
            prediction.step()
            self._switch(now)

    def _replaced(self, now: float) -> None:
        """The confirmed world is another now: the server's."""
        self.prediction.distrust()
        if self._study is not None:
            self._study.state(now, self.confirmed)

    def _switch(self, now: float) -> None:
        before = self.prediction.switched(self.confirmed)
        if before is not None:
            self.screen.switched(before, self.prediction, now=now, rate=self.joined.about.rate)

    def _note_lag(self) -> None:
        behind = self.follower.behind
        if not self._lagging and behind > LAG_SECONDS * self.joined.about.rate:
            self._lagging = True
            log.warning("%d ticks behind the stream: this machine steps slower than the server", behind)
        elif self._lagging and behind == 0:
            self._lagging = False
            log.info("caught up with the stream")

    def _acting_tick(self, now: float) -> int:
        """The next that is predicted; who is behind with predicting leaves out those that are over at the server."""
        return max(self.prediction.shown[1].tick, math.floor(self.clock.target(now)) - 1)

    def _let_bot_act(self, now: float) -> None:
        if self._autopilot is None or self.outbox is None or self.outbox.full:
            return
        given = self._autopilot.wants(Sight(self.prediction.shown[1], self.own), self._acting_tick(now))
        if given is not None:
            self.act(given)

    def _rejoin(self, epoch: int) -> None:
        """A message of another run of the server came: see which one runs now."""
        joined = self._join(time.monotonic() + self.settings.wait)
        if len(self._other_epochs) >= KNOWN_EPOCHS:
            self._other_epochs.clear()
        if joined.epoch == self.epoch:
            log.warning("a message of epoch %d, but the server runs %d still: ignored", epoch, self.epoch)
            self._other_epochs.add(epoch)
            return
        log.warning("world %s was restarted: joined again", self._keys.world)
        self._other_epochs.add(self.epoch)
        self.totals.keep(figures(self))
        self.totals.rejoins += 1
        self._enter(joined)
