"""Who plays: liveliness tokens become joins and leaves, names become the small numbers that order inputs."""

from __future__ import annotations

import logging
from collections import OrderedDict
from dataclasses import dataclass, field

from kuglice import Scene, World
from kuglice.errors import InputError
from kuglice.inputs import Input, Leave, join
from kuglice.protocol import Ack, Admission, ClientStatus
from kuglice_server.counters import Counters

__all__ = ["Player", "Players"]

log = logging.getLogger(__name__)

MAX_PLAYERS = 256
"""Where the scene gives no bound of its own."""
MAX_NAMES = 4096
"""Names remembered after their clients left; the longest gone are forgotten first. So many may wait to be let in."""
REMEMBERED_OUTCOMES = 256
DISMISSED = "dismissed: "
"""What a client is told before the reason, so that it is not taken for one who was refused in the first place."""

Who = tuple[str, str]
"""Name and session."""


@dataclass
class Player:
    """A name and what is known of it. It keeps number and sequence when it leaves and comes back.

    `session`: the one that plays it. `away_since`: the tick at which its token vanished, None while it is there.
    `heard`: the first tick that it misses, as far as it has said.
    """

    name: str
    number: int
    present: bool = False
    session: str = ""
    away_since: int | None = None
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
    """Clients of one world. Not for two threads at once: the owner locks.

    A name is played by one session at a time: the first one that came. `grace`: ticks for which a player whose token
    vanished is still here, ball and all, so that the same session goes on with it once its link is back. Who comes
    while as many wait as may wait is counted as `arrivals_ignored`, and let in once its token appears again.
    """

    def __init__(self, scene: Scene, *, grace: int, counters: Counters) -> None:
        self._scene = scene
        self._grace = grace
        self._counters = counters
        self._by_name: OrderedDict[str, Player] = OrderedDict()
        self._waiting: dict[Who, None] = {}
        self._refused: dict[Who, str] = {}
        self._dismissed: dict[Who, str] = {}
        self._leaves: list[Input] = []
        self._numbers = 0
        self._sequence = 0

    @property
    def present(self) -> list[Player]:
        """Those who are here, and those whose return is waited for, by number."""
        return sorted(
            (player for player in self._by_name.values() if player.present), key=lambda one: one.number
        )

    @property
    def playing(self) -> list[Who]:
        """Names and sessions of those who are here."""
        return [(player.name, player.session) for player in self.present]

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

    def find(self, name: str, session: str) -> Player | None:
        """The player of that name, if it is here and this session is the one that plays it."""
        player = self._by_name.get(name)
        return player if player is not None and player.present and player.session == session else None

    def settled(self, name: str, session: str) -> bool:
        """Whether it is clear if this session plays `name`: it does, or it was refused."""
        return self.find(name, session) is not None or self._why_not((name, session)) is not None

    def numbered(self, number: int) -> Player | None:
        """The player of that number, here or not."""
        return next((player for player in self._by_name.values() if player.number == number), None)

    def arrive(self, name: str, session: str) -> None:
        """A token appeared: somebody new, or one whose link is back. One who was dismissed stays out."""
        if (name, session) in self._dismissed:
            return
        player = self.find(name, session)
        if player is None:
            if (name, session) in self._waiting or len(self._waiting) < MAX_NAMES:
                self._waiting[name, session] = None
            else:
                self._counters.add("arrivals_ignored")
        elif player.away_since is not None:
            player.away_since = None
            log.info("%s (client %d) is back", name, player.number)

    def depart(self, name: str, session: str, tick: int) -> None:
        """A token disappeared: its link is cut, or its process has ended. It has `grace` ticks to come back."""
        self._waiting.pop((name, session), None)
        self._refused.pop((name, session), None)
        player = self.find(name, session)
        if player is not None and player.away_since is None:
            player.away_since = tick
            log.info("%s (client %d) is away", name, player.number)

    def leave(self, name: str, session: str) -> None:
        """It said that it goes, and need not be waited for."""
        self._waiting.pop((name, session), None)
        player = self.find(name, session)
        if player is not None:
            self._let_go(player)

    def dismiss(self, name: str, reason: str) -> None:
        """As `Server.dismiss`. Raises InputError if nobody plays under that name, or the reason cannot be told."""
        most = Admission.max_reason - len(DISMISSED)
        if not 1 <= len(reason) <= most:
            raise InputError(
                f"dismiss {name[:64]!r}: a reason of {len(reason)} characters, must be 1 to {most}"
            )
        player = self._by_name.get(name)
        if player is None or not player.present:
            raise InputError(f"dismiss {name[:64]!r}: must be one of those who play, {len(self.present)} now")
        _remember(self._dismissed, (name, player.session), f"{DISMISSED}{reason}")
        log.info("%s (client %d) is dismissed: %s", name, player.number, reason)
        self._let_go(player)

    def authored(self, world: World) -> list[Input]:
        """Leaves since the last call, of those away for too long too, and the join of one who waits.

        One per tick, since the next one's spawn point depends on where this one's ball is.
        """
        for player in self.present:
            if player.away_since is not None and world.tick - player.away_since >= self._grace:
                self._let_go(player)
        authored, self._leaves = self._leaves, []
        waiting = None if authored else self._next_waiting()
        if waiting is not None:
            name, session = waiting
            try:
                authored.append(self._admit(name, session, world))
            except InputError as error:
                log.warning("%s is refused: %s", name, error)
                _remember(self._refused, waiting, str(error)[: Admission.max_reason])
        return authored

    def _why_not(self, who: Who) -> str | None:
        """Why that session will not be let in, None where that is open."""
        return self._dismissed.get(who) or self._refused.get(who)

    def _next_waiting(self) -> Who | None:
        """The first of those who need wait no longer, taken from the queue."""
        for waiting in self._waiting:
            if self._is_kept(waiting[0]):
                # Perhaps the same person at a new start: until the old session is given up.
                continue
            del self._waiting[waiting]
            return waiting
        return None

    def _is_kept(self, name: str) -> bool:
        """Whether the session that plays it is away, and waited for."""
        holder = self._by_name.get(name)
        return holder is not None and holder.present and holder.away_since is not None

    def _let_go(self, player: Player) -> None:
        player.present, player.away_since = False, None
        self._leaves.append(Leave(client=player.number, sequence=self._next_sequence()))
        log.info("%s (client %d) leaves", player.name, player.number)

    def status(self) -> dict[str, ClientStatus]:
        """Everyone who is here, by name."""
        return {
            player.name: ClientStatus(
                number=player.number,
                away=player.away_since is not None,
                sequence=player.sequence,
                accepted=player.accepted,
                late=player.late,
                refused=player.refused,
            )
            for player in self.present
        }

    def admission(self, name: str, session: str, *, epoch: int) -> Admission:
        """How it stands with that session."""
        player = self.find(name, session)
        return Admission(
            epoch=epoch,
            number=None if player is None else player.number,
            sequence=0 if player is None else player.sequence,
            refused=self._why_not((name, session)),
            kept=player is None and self._is_kept(name),
        )

    def _admit(self, name: str, session: str, world: World) -> Input:
        known = self._by_name.get(name)
        number = known.number if known is not None else self._numbers + 1
        if known is not None and known.present:
            raise InputError(f"join: {name} is played by another session already, at most 1 allowed")
        here = len(self.present)
        if here >= MAX_PLAYERS:
            raise InputError(f"join: client {number} refused at {here} players, at most {MAX_PLAYERS}")
        joined = join(self._scene, world, number, self._next_sequence())
        if known is None:
            self._numbers = number
            known = self._by_name[name] = Player(name, number)
            self._forget()
        self._by_name.move_to_end(name)
        known.present, known.session, known.away_since = True, session, None
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


def _remember(reasons: dict[Who, str], who: Who, reason: str) -> None:
    reasons[who] = reason
    if len(reasons) > MAX_NAMES:
        del reasons[next(iter(reasons))]
