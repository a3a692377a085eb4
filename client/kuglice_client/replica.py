"""The server's world, here: confirmed by its ticks, and predicted ahead of them."""

from __future__ import annotations

import logging
import math
import threading
import time

from kuglice.protocol import Admission, History, Keys, Tick
from kuglice.study.recorder import StudyRecorder
from kuglice_client.clock import Clock
from kuglice_client.credibility import Credibility
from kuglice_client.follow import Follower
from kuglice_client.healing import Healing
from kuglice_client.join import Joined, Who
from kuglice_client.link import Link
from kuglice_client.pinging import Pinging
from kuglice_client.player import Player
from kuglice_client.prediction import Prediction
from kuglice_client.reconcile import Reconciler
from kuglice_client.screen import Screen
from kuglice_client.settings import ClientSettings
from kuglice_client.stream import Stream
from kuglice_client.totals import Totals

__all__ = ["Replica"]

log = logging.getLogger(__name__)

PREDICTED_SECONDS = 1.5
LAG_SECONDS = 2.0
"""That a client may be behind, and for how long, before it says so."""
CONFIRM_SECONDS = 0.05
STEP_WEIGHT = 0.05
"""Of a turn, in the mean of what a confirmed tick costs."""
ENTER_SECONDS = 5.0
"""Who has not come to the present by then is shown what there is."""
ENTER_SLACK_SECONDS = 0.25
"""By which the stream may be late for once, and is the present all the same."""
ENTER_IDLE_SECONDS = 0.001
DOUBTED_TRIP_SECONDS = 0.4
"""Who measured a longer one while joining asks once more: one lost segment adds that much, and few ways are so long."""
PREDICT_SECONDS = 0.012
"""Of one turn: running forward again that takes longer goes on in the next, and frames come in between."""


class Replica:
    """Made by joining one run of the server, thrown away when another one is joined.

    `enter` brings it to the present; then a turn is: `receive`, `heal`, `advance`. `player` is None for a spectator.
    """

    def __init__(
        self,
        joined: Joined,
        link: Link,
        keys: Keys,
        settings: ClientSettings,
        *,
        who: Who | None,
        screen: Screen,
        study: StudyRecorder | None,
        totals: Totals,
        now: float,
    ) -> None:
        about = joined.about
        self.joined = joined
        self._link = link
        self._screen = screen
        self._study = study
        self._lagging = False
        self._lags_since: float | None = None
        self._entered = False
        self._step_seconds = 0.0
        self._news_at = now
        self.credibility = Credibility(link, keys, joined)
        self.stream = Stream(link, joined, self.credibility, lose=settings.lose, totals=totals, now=now)
        self.follower = Follower(joined.world)
        self.reconciler = Reconciler(
            self.follower,
            snapshot_every=about.snapshot_every if settings.check_snapshots else None,
            reports=settings.desync_reports,
            step_version=about.step_version,
        )
        self.healing = Healing(
            link,
            keys,
            epoch=joined.epoch,
            follower=self.follower,
            reconciler=self.reconciler,
            state_seconds=joined.state_seconds,
        )
        self.prediction = Prediction(joined.world, limit=max(4, round(PREDICTED_SECONDS * about.rate)))
        self.clock = Clock(
            rate=about.rate,
            tick=joined.told_tick,
            now=joined.told_at,
            round_trip=joined.round_trip,
            input_delay=settings.input_delay,
            in_order="udp" not in link.kinds,
        )
        self._pinging = Pinging(link, keys, epoch=joined.epoch, who=who, now=now)
        self.player = (
            None
            if joined.number is None
            else Player(
                joined,
                settings,
                joined.number,
                clock=self.clock,
                prediction=self.prediction,
                feel=screen.feel,
                study=study,
            )
        )

    def enter(self, *, deadline: float, stop: threading.Event) -> None:
        """Catch up with what was told while the state was on its way, and predict up to now.

        Nobody sees that or acts meanwhile: it would be seconds of the past, played too fast. Ends at the `deadline`,
        when `stop` is set, or when the server is another run by now, in any case.
        """
        until = min(deadline, time.monotonic() + ENTER_SECONDS)
        begun = False
        while (now := time.monotonic()) < until and not self.over:
            self.receive(now)
            self.heal(now)
            # The clock begins to run here, and never runs back: not before it is known how far ahead it must be.
            begun = begun or (self._is_present(now) and self._knows_the_way())
            if begun:
                self.advance(now)
            else:
                self._confirm(now)
            if begun and self._is_present(now) and self._has_predicted():
                break
            if stop.wait(ENTER_IDLE_SECONDS):
                break
        self._entered = True

    def _is_present(self, now: float) -> bool:
        return self.follower.behind == 0 and self.follower.world.tick >= self._told_by(now)

    def _knows_the_way(self) -> bool:
        """Whether the round trip is one to go by, or a long one that may have been held up is the only one known."""
        return self.clock.round_trip <= DOUBTED_TRIP_SECONDS or self._pinging.answers > 0

    def _has_predicted(self) -> bool:
        """Whether prediction is as far as the clock, or as far as it ever goes."""
        ahead = math.floor(self.clock.target(time.monotonic()))
        return self.prediction.world.tick >= min(ahead, self.follower.world.tick + self.prediction.limit)

    def _told_by(self, now: float) -> float:
        """The tick that the stream should have come to by `now`, going by when the server told which tick it was."""
        joined = self.joined
        return joined.told_tick + (now - joined.told_at - ENTER_SLACK_SECONDS) * joined.about.rate - 1.0

    @property
    def over(self) -> bool:
        """Whether the server is another run by now, or has given our player up: then the world is to be joined anew."""
        told = self._told_of_us
        given_up = told is not None and told.number != self.joined.number
        return given_up or self.credibility.restarted

    @property
    def busy(self) -> bool:
        """Whether something is asked for, or more is known than can be stepped through in a turn."""
        return self.healing.asking or self.follower.behind * self._step_seconds > CONFIRM_SECONDS

    def silent(self, now: float) -> bool:
        """Whether nothing has come for so long that what is drawn is a guess, neither by the stream nor when asked."""
        return now - self._news_at > self.stream.silence_seconds

    @property
    def refused(self) -> str | None:
        """Why this run of the server will not have us any more, None while it will: joining anew is in vain."""
        told = self._told_of_us
        return None if told is None else told.refused

    @property
    def _told_of_us(self) -> Admission | None:
        told = self._pinging.admission
        return told if told is not None and told.epoch == self.joined.epoch else None

    def receive(self, now: float) -> None:
        """Take in what came."""
        # Snapshots first: one that is ahead waits for its tick, one that is far behind cannot be compared.
        for whole in self.stream.snapshots():
            if self.reconciler.received(whole):
                self._replaced(now)
        for message in self.stream.ticks(now):
            self._heard(message, now)

    def heal(self, now: float) -> None:
        """Ask for what is missing or in doubt, and take in what was answered."""
        self.credibility.turn(now)
        silent = self.stream.silent(now)
        missing = max(self.follower.behind, (now - self.stream.heard_at) * self.joined.about.rate)
        if self.healing.turn(now, missing=missing, step_seconds=self._step_seconds, silent=silent):
            self._replaced(now)
        if self.healing.brought is not None:
            self._brought(self.healing.brought, now, silent=silent)
        round_trip = self._pinging.turn(now, self.follower.world.tick - 1)
        if round_trip is not None:
            self.clock.answered(round_trip)

    def advance(self, now: float) -> float:
        """Confirm, predict up to now, send. Returns how far the drawn state is from one tick to the next."""
        target = self.clock.target(now)
        # Who has not even confirmed what is known has no time for guesses.
        confirmed = self._confirm(now)
        self._predict(math.floor(target), now, step=confirmed)
        if self.player is not None:
            message = self.player.message(now, self.follower.world.tick)
            if message is not None:
                self._link.send(message)
        return max(0.0, min(1.0, target - self.prediction.shown[1].tick))

    def _heard(self, message: Tick, now: float) -> None:
        self._news_at = now
        self._screen.feel.heard(now)
        self.clock.heard(message.end, now)
        if self.player is not None:
            self.player.answered(message.outcomes(self.player.outbox.number), now)
        self.follower.take(message)

    def _brought(self, history: History, now: float, *, silent: bool) -> None:
        """Ticks from the history stand in for a stream that has stopped."""
        if self.player is not None:
            self.player.answered(history.acting(self.player.outbox.number), self.stream.heard_at)
        if silent:
            self._news_at = now
            self.clock.heard(history.end, now)
            self._screen.feel.heard(now)

    def _confirm(self, now: float) -> bool:
        """Step through what is known, or, if that is much, through some of it. Whether that was all."""
        done = True
        before, begun = self.follower.world.tick, time.monotonic()
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
        stepped = self.follower.world.tick - before
        if stepped > 0:
            spent = (time.monotonic() - begun) / stepped
            self._step_seconds += STEP_WEIGHT * (spent - self._step_seconds)
        if self.follower.behind == 0:
            self._screen.feel.caught_up(time.monotonic())
        self._note_lag()
        return done

    def _predict(self, tick: int, now: float, *, step: bool) -> None:
        """Run forward again what was wrong, then on to `tick` if there is time to `step`.

        What is too much for this turn waits for the next.
        """
        confirmed, prediction = self.follower.world, self.prediction
        until = time.monotonic() + PREDICT_SECONDS

        def in_time() -> bool:
            return step and time.monotonic() < until

        reached = prediction.world.tick
        if prediction.reconcile(confirmed, in_time) and self._study is not None:
            self._study.rollback(now, confirmed.tick, reached)
        self._switch(now)
        if tick > prediction.shown[1].tick and self.player is not None and self._entered:
            self.player.let_bot_act(now)
        while step and prediction.world.tick < tick and in_time() and prediction.may_step(confirmed):
            prediction.step()
            self._switch(now)

    def _replaced(self, now: float) -> None:
        """The confirmed world is another now: the server's."""
        self.prediction.distrust()
        if self._study is not None:
            self._study.state(now, self.follower.world)

    def _switch(self, now: float) -> None:
        before = self.prediction.switched(self.follower.world)
        if before is not None:
            self._screen.switched(before, self.prediction, now=now, rate=self.joined.about.rate)

    def _note_lag(self) -> None:
        behind = self.follower.behind
        if behind <= LAG_SECONDS * self.joined.about.rate:
            self._lags_since = None
        elif self._lags_since is None:
            # One that was stopped, or cut off, steps through what it missed at once.
            self._lags_since = time.monotonic()
        elif not self._lagging and time.monotonic() - self._lags_since > LAG_SECONDS:
            self._lagging = True
            log.warning("%d ticks behind the stream: this machine steps slower than the server", behind)
        if self._lagging and behind == 0:
            self._lagging = False
            log.info("caught up with the stream")
