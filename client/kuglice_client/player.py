"""Who acts: own inputs, from being made, by a bot or by whoever calls, until the server says what became of them."""

from __future__ import annotations

import logging
import math
import time
from collections import deque
from collections.abc import Iterable

from kuglice.errors import JoinError
from kuglice.inputs import Input, rounded
from kuglice.protocol import Ack, ClientInputs
from kuglice.study.recorder import StudyRecorder
from kuglice_client.autopilot import Autopilot
from kuglice_client.bots import Sight
from kuglice_client.clock import Clock
from kuglice_client.feel import Feel
from kuglice_client.join import Joined
from kuglice_client.outbox import MAX_PENDING, Outbox, Outcome
from kuglice_client.prediction import Prediction
from kuglice_client.settings import ClientSettings

__all__ = ["Player"]

log = logging.getLogger(__name__)


class Player:
    """The client `number` of the run of the server that was joined; acts in `prediction` at once."""

    def __init__(
        self,
        joined: Joined,
        settings: ClientSettings,
        number: int,
        *,
        clock: Clock,
        prediction: Prediction,
        feel: Feel,
        study: StudyRecorder | None,
    ) -> None:
        rate = joined.about.rate
        self._scene = joined.scene
        self._input_delay = settings.input_delay
        self._exact = settings.exact_inputs
        self._clock = clock
        self._prediction = prediction
        self._feel = feel
        self._study = study
        self._autopilot = None if settings.bot is None else Autopilot(settings.bot, rate=rate)
        self._outcomes: deque[Outcome] = deque(maxlen=MAX_PENDING)
        self.outbox = Outbox(
            epoch=joined.epoch,
            number=number,
            sequence=joined.sequence,
            tick_seconds=1 / rate,
            resend_seconds=max(0.1, 2 * joined.round_trip),
        )

    @property
    def ball(self) -> int | None:
        """Id of one's own ball, once it exists."""
        return dict(self._prediction.shown[1].players).get(self.outbox.number)

    def act(self, given: Input, now: float) -> Input:
        """As `Client.act`. Raises JoinError when too much is unacknowledged to add more."""
        if self.outbox.full:
            raise JoinError("too many inputs are unacknowledged: the server does not answer")
        if not self._exact:
            given = rounded(given, self._scene)
        tick = self._acting_tick(now) + self._input_delay
        mine = self.outbox.add(given, tick, lead=self._clock.lead, made=now)
        self._prediction.act(mine, tick)
        if self._study is not None:
            self._study.acted(now, mine, tick)
        self._feel.acted(mine.sequence, tick, now)
        return mine

    def outcomes(self) -> list[Outcome]:
        """As `Client.outcomes`."""
        told = list(self._outcomes)
        self._outcomes.clear()
        return told

    def let_bot_act(self, now: float) -> None:
        """If one plays, and wants something new."""
        if self._autopilot is None or self.outbox.full:
            return
        given = self._autopilot.wants(Sight(self._prediction.shown[1], self.ball), self._acting_tick(now))
        if given is not None:
            self.act(given, time.monotonic())

    def message(self, now: float, heard: int) -> ClientInputs | None:
        """What is to be sent now, if anything is; `heard` is the tick that we miss."""
        return self.outbox.message(now, heard)

    def answered(self, outcomes: Iterable[Ack], now: float) -> None:
        """The server says what became of inputs: the prediction and the clock learn from it."""
        for ack in outcomes:
            pending = self.outbox.resolve(ack)
            if pending is None:
                continue
            self._outcomes.append(Outcome(pending.given, ack.tick, ack.refused))
            self._prediction.settle(pending.given, pending.tick, ack.tick)
            early = pending.early(ack)
            if self._study is not None:
                self._study.answered(now, pending.given.sequence, ack.tick, early)
            if early is not None:
                self._clock.reported(early, lead=pending.lead, made=pending.made)
            if ack.refused is not None:
                log.warning("refused: %s", ack.refused)

    def _acting_tick(self, now: float) -> int:
        """The next that is predicted; who is behind with predicting leaves out those that are over at the server."""
        return max(self._prediction.shown[1].tick, math.floor(self._clock.target(now)) - 1)
