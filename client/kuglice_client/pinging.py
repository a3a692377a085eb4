"""How long the way to the server and back takes, and whether we play there still: asked now and then.

Who plays asks whether it does; a spectator asks for one tick of the history again.
"""

from __future__ import annotations

from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import Admission, Keys, TickRange, decode
from kuglice_client.join import Who, arrival
from kuglice_client.link import Asked, Link

__all__ = ["Pinging"]

EVERY_SECONDS = 2.0
FIRST_EVERY_SECONDS = 0.1
FIRST = 8
"""Asked in quick succession: a single answer that was held up would be taken for how long the way is."""


class Pinging:
    """One small question at a time. `who`: name and session that play, None for a spectator."""

    def __init__(self, link: Link, keys: Keys, *, epoch: int, who: Who | None, now: float) -> None:
        self._link = link
        self._keys = keys
        self._epoch = epoch
        self._who = who
        self._session = link.session
        self._asked: Asked | None = None
        self._asked_at = now - FIRST_EVERY_SECONDS
        self._first_left = FIRST
        self.answers = 0
        self.admission: Admission | None = None
        """What the server last said of us."""

    @property
    def idle(self) -> bool:
        """Whether no answer is waited for."""
        return self._asked is None

    def turn(self, now: float, tick: int) -> float | None:
        """Ask, or hear the answer; then the seconds that it took. `tick` is one that the server has made."""
        if self._session is not self._link.session:
            # After a cut it may be another who plays, and what was asked over the old link is not answered.
            self._session, self._asked, self._asked_at = self._link.session, None, now - EVERY_SECONDS
        if self._asked is None:
            every = FIRST_EVERY_SECONDS if self._first_left else EVERY_SECONDS
            if now - self._asked_at >= every and tick >= 0:
                self._asked, self._asked_at = self._ask(tick), now
                self._first_left = max(0, self._first_left - 1)
            return None
        answered = True
        try:
            replies = self._asked.poll()
            if replies is None:
                return None
            if self._who is not None:
                self.admission = decode(replies[0], Admission)
        except JoinError:
            # A no takes as long as a yes; silence measures nothing.
            answered = self._asked.refused
        except ProtocolError:
            answered = False
        self._asked = None
        self.answers += answered
        return now - self._asked_at if answered else None

    def _ask(self, tick: int) -> Asked:
        if self._who is not None:
            return self._link.ask(self._keys.status, arrival(self._who))
        return self._link.ask(self._keys.history, TickRange(epoch=self._epoch, first=tick, end=tick + 1))
