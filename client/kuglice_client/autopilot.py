"""A bot at the controls: asked now and then, and heard only when it changes its mind."""

from __future__ import annotations

from kuglice.inputs import Input
from kuglice_client.bots import BOTS, Bot, Sight

__all__ = ["Autopilot"]

SECONDS = 1 / 15
"""From one question to the next."""


class Autopilot:
    """`bot`: an entry of BOTS, or a function like them. `rate`: ticks per second."""

    def __init__(self, bot: str | Bot, *, rate: float) -> None:
        self._think = BOTS[bot] if isinstance(bot, str) else bot
        self._every = max(1, round(SECONDS * rate))
        self._next = 0
        self._said: Input | None = None

    def wants(self, sight: Sight, tick: int) -> Input | None:
        """What to do at `tick`, if anything new."""
        if tick < self._next:
            return None
        self._next = tick + self._every
        given = self._think(sight)
        # Inputs are held until changed: saying the same again would only cost bytes.
        if given is None or given == self._said:
            return None
        self._said = given
        return given
