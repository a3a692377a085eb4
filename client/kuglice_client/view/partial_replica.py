"""A part of the server's world, here: told of in regions, and stepped on in between."""

from __future__ import annotations

import math

from kuglice import Model, Scene
from kuglice.errors import JoinError, KugliceError
from kuglice.protocol import Holding, Keys, Nodes, Payload, Rectangle, ViewAbout, decode
from kuglice_client.correction import Correction
from kuglice_client.view.clock import ViewClock
from kuglice_client.view.hearing import Hearing
from kuglice_client.view.interest import Interest
from kuglice_client.view.known import KnownWorld
from kuglice_client.view.mosaic import Compare
from kuglice_client.view.settings import ViewSettings

__all__ = ["PartialReplica"]

BALANCED_EVERY_SECONDS = 0.5
SILENCE_SECONDS = 2.0
"""Even of an empty region, and of players who do nothing, a server says once a second that it is so."""
SILENCE_ROUNDS = 3.0
"""Or as often as it tells anything, where that is more seldom."""


class PartialReplica:
    """Made of what one run of the server says `about` itself, thrown away for that of another run.

    `compare`: see Mosaic. Raises JoinError for a world that cannot be.
    """

    def __init__(self, about: ViewAbout, settings: ViewSettings, *, compare: Compare, now: float) -> None:
        try:
            self.scene = Scene.from_message(about.scene)
            model = Model.from_message(about.model)
            self.nodes = Nodes(self.scene.box, about.regions.depth)
            self._hearing = Hearing(about, self.nodes, now=now)
        except KugliceError as error:
            raise JoinError(f"world {about.world}: {error}") from error
        self.about = about
        self._keys = Keys(about.world)
        self.clock = ViewClock(rate=about.rate, tick=about.tick, now=now)
        self.known = KnownWorld(
            self.scene,
            model,
            tick=about.tick,
            every=max(1, round(about.rate / about.regions.rate)),
            node_of=self._hearing.packer.node,
            compare=compare,
        )
        self.interest = Interest(
            self.nodes, rate=about.regions.rate, balls=about.balls, budget=settings.budget
        )
        left, bottom, right, top = self.nodes.rectangle(0)
        self._margin = min(right - left, top - bottom) / 2 if settings.margin is None else settings.margin
        self.silence_seconds = max(SILENCE_SECONDS, SILENCE_ROUNDS / about.regions.rate)
        """More than a server that keeps its rate is ever silent for."""
        self._newest = about.tick
        self._balanced_at = now
        self._heard_at = now
        self.updates = 0
        self.balls_told = 0

    def look_at(self, rectangle: Rectangle) -> None:
        """Follow the regions that cover the rectangle and its margin, and forget the others."""
        self.interest.choose(rectangle, self._margin)
        self.known.follow(self.interest.paces)

    def out_of_balance(self, now: float) -> bool:
        """Whether `look_at` again would pay, for the budget's sake; looked at now and then."""
        if self.interest.first_words_came:
            return True
        if now - self._balanced_at <= BALANCED_EVERY_SECONDS:
            return False
        self.interest.passed(now - self._balanced_at)
        self._balanced_at = now
        return self.interest.out_of_balance

    def silent(self, now: float) -> bool:
        """Whether nothing of this run has come for longer than that."""
        return now - self._heard_at > self.silence_seconds

    def overdue(self, about: ViewAbout) -> bool:
        """Whether the server, as it says now, has made more ticks than it is silent for: they did not get here.

        One that is slower than it should be, or stands still, has nothing to tell, and its link may be well.
        """
        return about.tick - self._newest > self.silence_seconds * about.rate

    def hear(self, key: str, payload: Payload, now: float) -> bool:
        """Take in a message. Whether it was of this run. Raises ProtocolError for what no server could say."""
        if key == self._keys.holding:
            message = decode(payload, Holding)
            if message.epoch != self.about.epoch:
                return False
            self._hearing.check_tick(message.tick, now=now)
            self.known.hold(message.tick, message.players, message.held)
            tick = message.tick
        else:
            told = self._hearing.region(key, payload, now=now)
            if told is None:
                return False
            self.interest.note(told.node, len(payload))
            self.updates += self.known.take(told)
            self.balls_told += len(told.id)
            tick = told.tick
        self._heard_at = now
        if tick > self._newest:
            self._newest = tick
            self.clock.heard(tick, now)
        return True

    def advance(self, now: float, correction: Correction) -> float:
        """Put right what was told, which `correction` glides over, and step up to now; returns alpha."""
        known = self.known
        if known.unsettled:
            before_id, before = known.world.id, known.world.position
            known.settle()
            world = known.world
            correction.moved(before_id, before, world.id, world.position, world.radius)
        target = self.clock.target(now)
        known.advance(math.floor(target))
        correction.frame(now, known.world.count)
        return max(0.0, min(1.0, target - known.world.tick))
