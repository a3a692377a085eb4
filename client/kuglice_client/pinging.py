"""How long the way to the server and back takes: now and then one tick of its history is asked for again."""

from __future__ import annotations

from kuglice.errors import JoinError
from kuglice.protocol import Keys, TickRange
from kuglice_client.link import Asked, Link

__all__ = ["Pinging"]

EVERY_SECONDS = 2.0


class Pinging:
    """One small question at a time; its answer is not needed, only when it comes."""

    def __init__(self, link: Link, keys: Keys, *, epoch: int, now: float) -> None:
        self._link = link
        self._keys = keys
        self._epoch = epoch
        self._asked: Asked | None = None
        self._asked_at = now

    def turn(self, now: float, tick: int) -> float | None:
        """Ask about `tick`, which the server has made, or hear the answer; then the seconds that it took."""
        if self._asked is None:
            if now - self._asked_at >= EVERY_SECONDS and tick >= 0:
                request = TickRange(epoch=self._epoch, first=tick, end=tick + 1)
                self._asked, self._asked_at = self._link.ask(self._keys.history, request), now
            return None
        try:
            if self._asked.poll() is None:
                return None
        except JoinError:
            # A no takes as long as a yes; silence measures nothing.
            refused, self._asked = self._asked.refused, None
            return now - self._asked_at if refused else None
        self._asked = None
        return now - self._asked_at
