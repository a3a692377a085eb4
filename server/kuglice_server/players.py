"""Who plays: liveliness tokens become joins and leaves, names become the small numbers that order inputs."""

from __future__ import annotations

import logging
from collections import OrderedDict
from dataclasses import dataclass, field

from kuglice import Scene, World
from kuglice.errors import InputError
from kuglice.inputs import Input, Leave, join
from kuglice.protocol import Ack, ClientStatus

__all__ = ["Player", "Players"]

log = logging.getLogger(__name__)

MAX_PLAYERS = 256
"""Where the scene gives no bound of its own."""
MAX_NAMES = 4096
"""Names remembered after their clients left; the longest gone are forgotten first."""
REMEMBERED_OUTCOMES = 256


@dataclass
class Player:
    """A name and what is known of it. It keeps number and sequence when it leaves and comes back.

    `heard`: the first tick that it misses, as far as it has said.
    """

    name: str
    number: int
    present: bool = False
    sequence: int = 0
    accepted: int = 0
    late: int = 0
    refused: int = 0
    last_tick: int = 0
    heard: int | None = None
    outcomes: OrderedDict[int, Ack] = field(default_factory=OrderedDict)

    def remember(self, sequence: int, ack: Ack) -> None:
        """Keep the outcome of an input for the case that the client asks again."""
        self.outcomes[sequence] = ack
        while len(self.outcomes) > REMEMBERED_OUTCOMES:
            self.outcomes.popitem(last=False)


class Players:
    """Clients of one world. Not for two threads at once: the owner locks."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._by_name: OrderedDict[str, Player] = OrderedDict()
        self._waiting: dict[str, None] = {}
        self._refused: dict[str, str] = {}
        self._leaves: list[Input] = []
        self._numbers = 0
        self._sequence = 0

    @property
    def present(self) -> list[Player]:
        """Those who are here, by number."""
        return sorted(
            (player for player in self._by_name.values() if player.present), key=lambda one: one.number
        )

    @property
    def heard(self) -> list[int]:
        """The first tick that each of those who are here misses, where they have said it."""
        return [player.heard for player in self.present if player.heard is not None]

    @property
    def deserted(self) -> bool:
        """Whether somebody was here and nobody is any more."""
        return (
            bool(self._by_name)
            and not self._waiting
            and not any(one.present for one in self._by_name.values())
        )

    def find(self, name: str) -> Player | None:
        """The player of that name, if it is here."""
        player = self._by_name.get(name)
        return player if player is not None and player.present else None

    def numbered(self, number: int) -> Player | None:
        """The player of that number, here or not."""
        return next((player for player in self._by_name.values() if player.number == number), None)

    def arrive(self, name: str) -> None:
        """A token appeared."""
        if self.find(name) is None and len(self._waiting) < MAX_NAMES:
            self._waiting[name] = None

    def depart(self, name: str) -> None:
        """A token disappeared."""
        self._waiting.pop(name, None)
        self._refused.pop(name, None)
        player = self.find(name)
        if player is None:
            return
        player.present = False
        self._leaves.append(Leave(client=player.number, sequence=self._next_sequence()))
        log.info("%s (client %d) leaves", name, player.number)

    def authored(self, world: World) -> list[Input]:
        """Leaves since the last call, and the join of one who waits.

        One per tick, since the next one's spawn point depends on where this one's ball is.
        """
        authored, self._leaves = self._leaves, []
        if self._waiting and not authored:
            name = next(iter(self._waiting))
            del self._waiting[name]
            try:
                authored.append(self._admit(name, world))
            except InputError as error:
                log.warning("%s is refused: %s", name, error)
                if len(self._refused) < MAX_NAMES:
                    self._refused[name] = str(error)[:400]
        return authored

    def status(self) -> dict[str, ClientStatus]:
        """Everyone who is here or was refused, by name."""
        here = {
            player.name: ClientStatus(
                number=player.number,
                sequence=player.sequence,
                accepted=player.accepted,
                late=player.late,
                refused=player.refused,
            )
            for player in self.present
        }
        refused = {
            name: ClientStatus(number=0, sequence=0, accepted=0, late=0, refused=0, refusal=reason)
            for name, reason in self._refused.items()
        }
        return here | refused

    def _admit(self, name: str, world: World) -> Input:
        known = self._by_name.get(name)
        number = known.number if known is not None else self._numbers + 1
        here = len(self.present)
        if here >= MAX_PLAYERS:
            raise InputError(f"join: client {number} refused at {here} players, at most {MAX_PLAYERS}")
        joined = join(self._scene, world, number, self._next_sequence())
        if known is None:
            self._numbers = number
            known = self._by_name[name] = Player(name, number)
            self._forget()
        self._by_name.move_to_end(name)
        known.present = True
        known.heard = None
        log.info("%s joins as client %d", name, number)
        return joined

    def _next_sequence(self) -> int:
        self._sequence += 1
        return self._sequence

    def _forget(self) -> None:
        absent = [name for name, player in self._by_name.items() if not player.present]
        for name in absent[: max(0, len(self._by_name) - MAX_NAMES)]:
            del self._by_name[name]
