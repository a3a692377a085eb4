"""One tick after the other: who came and went, what they want, the step, what came of it."""

from __future__ import annotations

import logging
import threading
from collections import Counter
from collections.abc import Callable
from functools import partial
from typing import Any

import zenoh

from kuglice import World
from kuglice.errors import InputError, ProtocolError, StepError
from kuglice.inputs import OWNER, Input, pack
from kuglice.protocol import MAX_TOLD_TICKS, Keys, StretchedTick
from kuglice_server.attempts import Attempt, attempts
from kuglice_server.counters import Counters
from kuglice_server.history import History, KeptSnapshot
from kuglice_server.inboxes import Inboxes
from kuglice_server.intake import Intake
from kuglice_server.owner import Owner
from kuglice_server.players import Players
from kuglice_server.publish import Publisher
from kuglice_server.record import Record
from kuglice_server.room import without_room

__all__ = ["TickLoop"]

log = logging.getLogger(__name__)

TOKENS_PER_TICK = 256
REPEATED_ACKS = 6
"""Tick messages that tell of a refusal."""


class TickLoop:
    """Owns the world. `lock` guards players and intake, which the answering threads read too."""

    def __init__(
        self,
        world: World,
        *,
        owner: Owner,
        players: Players,
        intake: Intake,
        history: History,
        publisher: Publisher,
        tokens: zenoh.Subscriber[Any],
        inboxes: Inboxes,
        snapshot_every: int,
        hash_every: int,
        counters: Counters,
        lock: threading.Lock,
        record: Record | None,
    ) -> None:
        self._world = world
        self._next = world.tick
        self._owner = owner
        self._players = players
        self._intake = intake
        self._history = history
        self._publisher = publisher
        self._tokens = tokens
        self._inboxes = inboxes
        self._snapshot_every = snapshot_every
        self._hash_every = hash_every
        self._counters = counters
        self._lock = lock
        self._record = record

    def tick(self) -> None:
        """Run the next tick and publish it."""
        world = self._world
        number = self._expected()
        with self._lock:
            # Inputs first: a goodbye is among them, and comes before the token that vanishes with it.
            self._take_inputs()
            self._note_tokens()
            authored = self._players.authored(world)
            inputs = self._with_room(authored, self._owner.due() + self._intake.due(number))
            heard = self._players.heard
            playing = self._players.playing
        self._inboxes.keep(playing)
        self._keep(number)
        records = self._step(authored, inputs)
        self._next = world.tick
        with self._lock:
            acks = self._intake.acks(number, repeat=REPEATED_ACKS)
        hashed = world.tick % self._hash_every == 0
        entry = StretchedTick(number, records, world.state_hash if hashed else None)
        self._history.add_tick(entry)
        self._guarded(partial(self._publisher.tick, self._history.recent(MAX_TOLD_TICKS), acks, heard))
        if self._record is not None:
            self._record.add(entry)

    def _expected(self) -> int:
        """The tick to make. A world that somebody else has stepped has ticks that no client will ever hear of."""
        if self._world.tick != self._next:
            raise StepError(
                f"the world is at tick {self._world.tick} instead of {self._next}: only its server may step it; "
                "rules of a game act by Server.act"
            )
        return self._next

    def _keep(self, number: int) -> None:
        asked_for = self._history.wants_fresh()
        if number % self._snapshot_every == 0:
            data = self._world.snapshot()
            self._history.add_snapshot(KeptSnapshot(number, data))
            self._guarded(partial(self._publisher.snapshot, number, data))
        elif asked_for:
            self._history.add_fresh(KeptSnapshot(number, self._world.snapshot()))

    def _note_tokens(self) -> None:
        # However many come: the rest waits for the next tick.
        for _ in range(TOKENS_PER_TICK):
            sample = self._tokens.try_recv()
            if sample is None:
                break
            try:
                who = Keys.client_of(str(sample.key_expr))
            except ProtocolError:
                self._counters.add("foreign")
                continue
            if sample.kind == zenoh.SampleKind.PUT:
                self._players.arrive(*who)
            else:
                self._players.depart(*who, self._world.tick)

    def _take_inputs(self) -> None:
        for key, payload in self._inboxes.take():
            if payload is None:
                self._players.leave(*Keys.client_of(key))
            else:
                self._intake.receive(key, payload, world=self._world)

    def _with_room(self, authored: list[Input], inputs: list[Input]) -> list[Input]:
        inputs = _ordered(inputs)
        refused = without_room(self._world, authored, inputs)
        for spawn, why in refused:
            self._leave_out(self._world.tick, spawn, why)
        return [one for one in inputs if not any(one is spawn for spawn, _ in refused)]

    def _step(self, authored: list[Input], inputs: list[Input]) -> bytes:
        failed: Exception | None = None
        for attempt in attempts(self._world, authored, inputs):
            # The step puts them into order itself; this order makes equal sets of inputs equal bytes.
            records = pack(_ordered(attempt.inputs))
            try:
                self._world.step(records, budget=attempt.budget)
            except (InputError, StepError) as error:
                log.error("%s", error)
                failed = failed or error
                continue
            if failed is not None:
                self._note_losses(attempt, authored, inputs, failed)
            return records
        raise StepError(
            f"tick {self._world.tick} cannot be made, not even without any input: {failed}"
        ) from failed

    def _note_losses(
        self, made: Attempt, authored: list[Input], inputs: list[Input], failed: Exception
    ) -> None:
        tick = self._world.tick - 1
        log.error("tick %d was made after all: %s", tick, made.loss)
        extra = Counter(one.kind for one in made.inputs if not any(one is other for other in authored))
        with self._lock:
            for one in inputs:
                self._leave_out(tick, one, f"left out: {failed}")
            self._counters.add("removed", extra.pop("remove", 0))
            self._counters.add("released", extra.total())

    def _leave_out(self, tick: int, one: Input, why: str) -> None:
        if one.client == OWNER:
            self._owner.left_out(one, why)
        else:
            self._intake.left_out(tick, one, why)

    def _guarded(self, publish: Callable[[], None]) -> None:
        try:
            publish()
        except (zenoh.ZError, ProtocolError) as error:
            if not self._counters["unpublished"]:
                log.error("tick %d cannot be published: %s", self._world.tick, error)
            self._counters.add("unpublished")


def _ordered(inputs: list[Input]) -> list[Input]:
    return sorted(inputs, key=lambda one: (one.client, one.sequence))
