"""How long the way to the server and back takes, and whether we play there still: asked now and then.

Who plays asks whether it does; a spectator asks for one tick of the history again.
"""

from __future__ import annotations

from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import ANY_EPOCH, Admission, ArrivalRequest, Keys, TickRange, decode
from kuglice_client.join import Who
from kuglice_client.link import Asked, Link

__all__ = ["Pinging"]

EVERY_SECONDS = 2.0


class Pinging:
    """One small question at a time. `who`: name and session that play, None for a spectator."""

    def __init__(self, link: Link, keys: Keys, *, epoch: int, who: Who | None, now: float) -> None:
        self._link = link
        self._keys = keys
        self._epoch = epoch
        self._who = who
        self._session = link.session
        self._asked: Asked | None = None
        self._asked_at = now
        self.admission: Admission | None = None
        """What the server last said of us."""

    def turn(self, now: float, tick: int) -> float | None:
        """Ask, or hear the answer; then the seconds that it took. `tick` is one that the server has made."""
        if self._session is not self._link.session:
            # After a cut it may be another who plays, and what was asked over the old link is not answered.
            self._session, self._asked, self._asked_at = self._link.session, None, now - EVERY_SECONDS
        if self._asked is None:
            if now - self._asked_at >= EVERY_SECONDS and tick >= 0:
                self._asked, self._asked_at = self._ask(tick), now
            return None
        try:
            replies = self._asked.poll()
            if replies is None:
                return None
            if self._who is not None:
                self.admission = decode(replies[0], Admission)
        except JoinError:
            # A no takes as long as a yes; silence measures nothing.
            refused, self._asked = self._asked.refused, None
            return now - self._asked_at if refused else None
        except ProtocolError:
            self._asked = None
            return None
        self._asked = None
        return now - self._asked_at

    def _ask(self, tick: int) -> Asked:
        if self._who is not None:
            name, session = self._who
            return self._link.ask(
                self._keys.status, ArrivalRequest(epoch=ANY_EPOCH, name=name, session=session)
            )
        return self._link.ask(self._keys.history, TickRange(epoch=self._epoch, first=tick, end=tick + 1))
