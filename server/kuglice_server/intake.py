"""Inputs from clients: validated, scheduled for a tick, acknowledged with that tick or the reason why not.

Every input has a defined answer:

- in time: acts in the tick it asks for; late: acts in the next tick. Either way it is acknowledged by the tick message
  in which it acts, which also says how early or late it came; one that acts much later is told at once as well;
- reordered: one client's inputs act in the order of their sequence numbers, which is kept by taking a number only
  once and never after a higher one: it is refused, since its turn is over;
- too early (beyond `horizon` ticks), or beyond the scene's limits: refused, with the reason;
- duplicate: never applied twice; acknowledged again if its client has heard of the tick that it acted in and asks all
  the same; older than what is remembered: refused;
- a sequence number far ahead of the last one: refused and not taken, or all that follow would be too low;
- impossible (a spawn where there is no room, or a tick that cannot be made with it): refused when its tick comes, by
  the tick loop, even if it was promised;
- of one who has left when its tick comes: refused likewise, or a pull would be held that nobody ends;
- more than `limits.per_tick` in one tick: the rest waits for the next, in order;
- malformed: a message that cannot be read, or is too large to be looked at, is refused as a whole, with the reason,
  under no sequence number;
- a flood: beyond MESSAGES_PER_TICK messages or INPUTS_PER_TICK inputs a tick, counted and not read; beyond
  ANSWERS_PER_TICK answers that no tick message gives by itself, counted and not given; what was lost is sent again;
- foreign (from nobody who is here, or from a session that does not play its name), or meant for another epoch:
  counted, not answered, since nobody would hear it.
"""

from __future__ import annotations

from collections import Counter, deque

from kuglice import Scene, World
from kuglice.errors import InputError, ProtocolError
from kuglice.inputs import Input, check
from kuglice.protocol import Ack, ClientInputs, Keys, Payload, SentInput, decode
from kuglice_server.counters import Counters
from kuglice_server.players import Player, Players

__all__ = ["Intake"]

CLIENT_KINDS = frozenset({"spawn", "remove", "thrust", "attract", "kick"})
MESSAGES_PER_TICK = 16
"""Messages of one client that are read per tick; what is lost is sent again until acknowledged."""
INPUTS_PER_TICK = 64
"""Inputs of one client that are read per tick, and those that come with the last of them."""
ANSWERS_PER_TICK = 8
"""To one client: everybody is told of them, and in several messages."""
SEQUENCE_JUMP = 1024
"""From one input of a client to its next at most; no client has as many unacknowledged."""
MAX_ACKS = 256
"""Outcomes per tick message; a client that does not hear of one asks again."""
SOON = 30
"""Ticks that a client waits for an input to act before it would like to know whether it came at all."""
PROMISES = 2
"""Tick messages that tell of an input that acts later: when it does it is told anyway."""
MAX_REASON = 160
"""Characters; keeps a tick message within one batch."""
MAX_PER_TICK = 600
"""Inputs of all clients in one tick, the rest waits for the next: as many as fit into one batch."""


class Intake:
    """Not for two threads at once: the owner locks."""

    def __init__(
        self, scene: Scene, players: Players, *, epoch: int, horizon: int, counters: Counters
    ) -> None:
        self._scene = scene
        self._players = players
        self._epoch = epoch
        self._horizon = horizon
        self._counters = counters
        self._scheduled: dict[int, list[Input]] = {}
        self._used: Counter[tuple[int, int]] = Counter()
        self._read: Counter[str] = Counter()
        self._read_inputs: Counter[str] = Counter()
        self._answered: Counter[int] = Counter()
        self._told: set[Ack] = set()
        self._new_acks: list[Ack] = []
        self._acks: deque[tuple[int, list[Ack]]] = deque()
        self._acting: dict[int, list[Ack]] = {}

    def receive(self, key: str, payload: Payload, *, world: World) -> None:
        """One message from the wire; `world` is the state that its tick will begin with. Raises nothing."""
        try:
            name, session = Keys.client_of(key)
        except ProtocolError:
            self._counters.add("foreign")
            return
        player = self._players.find(name, session)
        if player is None:
            self._counters.add("foreign")
            return
        self._read[name] += 1
        if self._read[name] > MESSAGES_PER_TICK or self._read_inputs[name] >= INPUTS_PER_TICK:
            self._counters.add("flooded")
            return
        try:
            message = decode(payload, ClientInputs)
        except ProtocolError as error:
            self._counters.add("malformed")
            self._tell(Ack(player.number, None, None, 0, _reason(str(error))))
            return
        self._read_inputs[name] += len(message.inputs)
        if message.epoch != self._epoch:
            self._counters.add("other_epoch")
            return
        player.heard = max(player.heard or 0, min(message.heard, world.tick))
        if player.away_since is not None:
            # Of two sessions of one client the old one's end may be told last. Whoever is heard is waited for on.
            player.away_since = world.tick
        for sent in message.inputs:
            self._take(player, sent, world, heard=message.heard)

    def due(self, tick: int) -> list[Input]:
        """Inputs that act in `tick`, which is not asked for again."""
        self._read.clear()
        self._read_inputs.clear()
        inputs = self._scheduled.pop(tick, [])
        for client in {one.client for one in inputs}:
            del self._used[client, tick]
        here = {player.number for player in self._players.present} if inputs else set()
        for one in inputs:
            if one.client not in here:
                self.left_out(tick, one, f"{one.kind} {one.sequence} of client {one.client}: it has left")
        return [one for one in inputs if one.client in here]

    def left_out(self, tick: int, one: Input, why: str) -> None:
        """An input that was due in `tick` does not act after all: refused, whatever was promised."""
        player = self._players.numbered(one.client)
        acting = self._acting.get(tick, [])
        promised = next(
            (ack for ack in acting if (ack.client, ack.sequence) == (one.client, one.sequence)), None
        )
        if player is None or promised is None:
            return
        acting.remove(promised)
        ack = promised._replace(tick=None, refused=_reason(why))
        player.remember(one.sequence, ack)
        player.accepted -= 1
        player.refused += 1
        self._counters.add("left_out")
        self._tell(ack)

    def acks(self, tick: int, *, repeat: int) -> list[Ack]:
        """Outcomes to publish with `tick`: of what acts in it, new ones, and again refusals of the last `repeat`."""
        if self._new_acks:
            self._acks.append((tick, self._new_acks))
            self._new_acks = []
            self._answered.clear()
        while self._acks and self._acks[0][0] <= tick - repeat:
            self._told.difference_update(self._acks.popleft()[1])
        acting = self._acting.pop(tick, [])
        told = [
            ack for since, acks in self._acks for ack in acks if ack.tick is None or tick - since < PROMISES
        ]
        return told[-MAX_ACKS:] + acting

    def _take(self, player: Player, sent: SentInput, world: World, *, heard: int) -> None:
        early = sent.tick - world.tick
        if sent.given.sequence <= player.sequence:
            self._again(player, sent.given.sequence, world.tick, early, heard=heard)
            return
        highest = player.sequence + SEQUENCE_JUMP
        if sent.given.sequence > highest:
            why = f"sequence {sent.given.sequence}: at most {highest} allowed, {SEQUENCE_JUMP} after the last one"
            self._refuse(player, sent.given.sequence, early, why)
            return
        player.sequence = sent.given.sequence
        try:
            one = sent.given.model_copy(update={"client": player.number})
            if one.kind not in CLIENT_KINDS:
                raise InputError(
                    f"{one.kind} {one.sequence} of client {one.client}: only the server decides on that"
                )
            check(one, self._scene, world)
            tick = self._tick_for(player, max(sent.tick, world.tick), world.tick)
        except InputError as error:
            player.remember(sent.given.sequence, self._refuse(player, sent.given.sequence, early, str(error)))
            return
        self._scheduled.setdefault(tick, []).append(one)
        self._used[player.number, tick] += 1
        player.last_tick = tick
        player.accepted += 1
        self._counters.add("accepted")
        if early < 0:
            player.late += 1
            self._counters.add("late")
        ack = Ack(player.number, one.sequence, tick, early, None)
        player.remember(one.sequence, ack)
        self._acting.setdefault(tick, []).append(ack)
        if tick > world.tick + SOON:
            self._tell(ack)

    def _refuse(self, player: Player, sequence: int, early: int, why: str) -> Ack:
        player.refused += 1
        self._counters.add("refused")
        ack = Ack(player.number, sequence, None, early, _reason(why))
        self._tell(ack)
        return ack

    def _tell(self, ack: Ack) -> None:
        """With the next tick message, unless those to come tell it anyway."""
        if ack in self._told:
            return
        if self._answered[ack.client] >= ANSWERS_PER_TICK:
            self._counters.add("unanswered")
            return
        self._answered[ack.client] += 1
        self._told.add(ack)
        self._new_acks.append(ack)

    def _tick_for(self, player: Player, tick: int, now: int) -> int:
        # Inputs of one client act in the order of their sequence numbers, so never before an earlier one.
        tick = max(tick, player.last_tick)
        while (
            self._used[player.number, tick] >= self._scene.limits.per_tick
            or len(self._scheduled.get(tick, ())) >= MAX_PER_TICK
        ):
            tick += 1
        if tick > now + self._horizon:
            raise InputError(f"tick {tick}: at most {self._horizon} ticks after {now}, the next one, allowed")
        return tick

    def _again(self, player: Player, sequence: int, now: int, early: int, *, heard: int) -> None:
        self._counters.add("duplicate")
        known = player.outcomes.get(sequence)
        if known is None:
            reason = f"sequence {sequence}: {player.sequence} came before; its outcome is not remembered"
            known = Ack(player.number, sequence, None, early, reason)
        if known.tick is not None and heard <= known.tick <= now + SOON:
            # The stream tells of it, and is just on its way to the client, or about to be.
            return
        self._tell(known)


def _reason(text: str) -> str:
    return text if len(text) <= MAX_REASON else f"{text[: MAX_REASON - 3]}..."
