"""A player and a server over a bad link, in virtual time: the real clock, outbox, intake and line."""

from __future__ import annotations

import heapq
import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count

from kuglice import World
from kuglice.inputs import Thrust, pack
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.line import Line
from kuglice.protocol import Ack, ClientInputs, Keys, StretchedTick, Tick, decode, encode
from kuglice_client.clock import Clock
from kuglice_client.outbox import Outbox
from kuglice_client.pinging import EVERY_SECONDS, FIRST, FIRST_EVERY_SECONDS
from kuglice_server.counters import Counters
from kuglice_server.intake import Intake
from kuglice_server.players import Players
from server.small_arena import small_arena

RATE = 60.0
TOLD, ACKS_REPEATED = 3, 6
TURN_SECONDS = 0.004
EPOCH = 1
PHASE = 0.0117
"""When the server's ticks are due, in seconds after those of the client's clock."""


@dataclass
class Played:
    """What came of it: how early each input was, and tick that was predicted, pace and lead at every turn."""

    outbox: Outbox
    clock: Clock
    early: list[int] = field(default_factory=list)
    turns: list[tuple[float, float]] = field(default_factory=list)
    paces: list[float] = field(default_factory=list)
    leads: list[float] = field(default_factory=list)

    @property
    def late_per_1000(self) -> float:
        return 1000 * sum(early < 0 for early in self.early) / len(self.early)


class Simulation:
    """`stream`: whether messages go in one reliable stream, as over tcp, or each for itself.

    `every`: ticks from one input to the next, on average. `server_lag`: seconds that tick n is late. `first_trip`:
    the round trip that is known at first. `queue`: seconds that a tick waits for a state that is sent before it.
    """

    def __init__(
        self,
        conditions: Conditions,
        *,
        stream: bool = False,
        every: float = 4.0,
        input_delay: int = 0,
        server_lag: Callable[[int], float] = lambda _: 0.0,
        first_trip: float | None = None,
        queue: Callable[[float], float] = lambda _: 0.0,
    ) -> None:
        scene = small_arena()
        players = Players(scene, grace=300, counters=Counters())
        self._intake = Intake(scene, players, epoch=EPOCH, horizon=120, counters=Counters())
        self._world = World(scene)
        self._players = players
        players.arrive("ana", "s1")
        self._ticks: list[StretchedTick] = []
        self._up, self._down = Line(conditions, 0), Line(conditions, 1)
        self._stream, self._every, self._input_delay = stream, every, input_delay
        self._lag, self._queue = server_lag, queue
        self._random = random.Random(conditions.seed)
        self._events: list[tuple[float, int, Callable[[float], None]]] = []
        self._order = count()
        self._predicted = 0
        number = 1
        longest = conditions.round_trip * (1 + conditions.jitter) + 0.002
        self._first_trip = longest if first_trip is None else first_trip
        self.played = Played(
            Outbox(
                epoch=EPOCH,
                number=number,
                sequence=0,
                tick_seconds=1 / RATE,
                resend_seconds=max(0.1, 2 * conditions.round_trip),
            ),
            Clock(
                rate=RATE,
                tick=0,
                now=0.0,
                round_trip=self._first_trip,
                input_delay=input_delay,
                in_order=stream,
            ),
        )

    def run(self, seconds: float) -> Played:
        self._at(PHASE, self._tick)
        self._at(self._first_trip, self._turn)
        for ping in range(FIRST):
            self._at(self._first_trip + ping * FIRST_EVERY_SECONDS, self._ping)
        self._at(self._first_trip + EVERY_SECONDS, self._ping_again)
        while self._events and self._events[0][0] < seconds:
            at, _, what = heapq.heappop(self._events)
            what(at)
        return self.played

    def _at(self, when: float, what: Callable[[float], None]) -> None:
        heapq.heappush(self._events, (when, next(self._order), what))

    def _send(self, line: Line, now: float, size: int, arrive: Callable[[float], None]) -> None:
        for arrival in (line.stream(now, size),) if self._stream else line.packet(now, size):
            self._at(arrival, arrive)

    def _tick(self, now: float) -> None:
        world, number = self._world, self._world.tick
        inputs = [*self._players.authored(world), *self._intake.due(number)]
        acks = self._intake.acks(number, repeat=ACKS_REPEATED)
        records = pack(sorted(inputs, key=lambda one: (one.client, one.sequence)))
        world.step(records)
        self._ticks = [*self._ticks[1 - TOLD :], StretchedTick(number, records, None)]
        data = encode(Tick.of(EPOCH, self._ticks, acks))
        self._send(self._down, now + self._queue(now), len(data), lambda at: self._hear(data, at))
        due = PHASE + world.tick / RATE
        self._at(max(now, due + self._lag(world.tick)), self._tick)

    def _hear(self, data: bytes, now: float) -> None:
        message = decode(data, Tick)
        played = self.played
        played.clock.heard(message.end, now)
        for ack in message.outcomes(played.outbox.number):
            self._answered(ack)

    def _answered(self, ack: Ack) -> None:
        played = self.played
        pending = played.outbox.resolve(ack)
        if pending is not None:
            early = pending.early(ack)
            if early is not None:
                played.clock.reported(early, lead=pending.lead, made=pending.made)

    def _turn(self, now: float) -> None:
        played = self.played
        target = played.clock.target(now)
        played.turns.append((now, target))
        played.paces.append(played.clock.pace)
        played.leads.append(played.clock.lead)
        self._predicted = self._predicted or math.floor(target)
        while self._predicted < math.floor(target):
            if self._random.random() < 1 / self._every and not played.outbox.full:
                tick = self._predicted + self._input_delay
                push = Thrust(x=self._random.random(), y=0.0)
                played.outbox.add(push, tick, lead=played.clock.lead, made=now)
            self._predicted += 1
        message = played.outbox.message(now, self._world.tick)
        if message is not None:
            data = encode(message)
            self._send(self._up, now, len(data), lambda _: self._receive(data))
        self._at(now + TURN_SECONDS, self._turn)

    def _receive(self, data: bytes) -> None:
        player = self._players.find("ana", "s1")
        known = 0 if player is None else player.sequence
        self._intake.receive(Keys("small").input("ana", "s1"), data, world=self._world)
        for sent in decode(data, ClientInputs).inputs:
            if sent.given.sequence > known:
                self.played.early.append(sent.tick - self._world.tick)

    def _ping(self, now: float) -> None:
        there, back = self._up.packet(now, 40, "query"), self._down.packet(now, 40, "query")
        if there and back:
            trip = there[0] + back[0] - 2 * now
            self._at(now + trip, lambda _: self.played.clock.answered(trip))

    def _ping_again(self, now: float) -> None:
        self._ping(now)
        self._at(now + EVERY_SECONDS, self._ping_again)
