"""How many of the last ticks a tick message tells again, so that one that was lost heals with the next.

Whatever nobody has said to have heard is worth telling again, as far as it is cheap: ticks without inputs cost nothing,
and the rest shares what is left of a number of bytes per second.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence

from kuglice.protocol import MAX_TOLD_TICKS, StretchedTick, packed_size

__all__ = ["DATAGRAM_BYTES", "Repeats"]

BITS_PER_SECOND = 18_000
"""Spent on the whole stream where that is enough, so that it stays well below 20 kbit/s; the newest ticks are told
whatever they cost."""
TOLD_ANYWAY = 2
"""The newest tick and the one before it: with 2 % of messages lost, 1 in 2,500 ticks is then asked for again."""
UNKNOWN = 6
"""Ticks told where no client says what it has heard."""
DATAGRAM_BYTES = 1_100
"""Fits into one packet of every network, with what Zenoh, UDP and IP wrap around it."""
SAVED_SECONDS = 0.15
"""How long a quiet time may be drawn on: what a session of seconds spends of it shows in its mean."""
OWED_SECONDS = 1.0
"""How long what the newest ticks cost beyond the rest is paid back."""


class Repeats:
    """`rate`: messages per second. Counts on being told of every message, in order."""

    def __init__(self, rate: float) -> None:
        self._earned = BITS_PER_SECOND / 8 / rate
        self._most = self._earned * max(1.0, SAVED_SECONDS * rate)
        self._least = -self._earned * max(1.0, OWED_SECONDS * rate)
        self._saved = 0.0
        self._sizes: deque[int] = deque(maxlen=MAX_TOLD_TICKS)

    def choose(self, recent: Sequence[StretchedTick], heard: Iterable[int], *, rest: int) -> int:
        """How many of the `recent` ticks, the last ones, to tell.

        `heard`: for each client the first tick that it misses. `rest`: bytes of the message besides inputs.
        """
        newest = recent[-1].tick
        self._sizes.append(packed_size(recent[-1].inputs))
        self._saved = min(self._saved + self._earned, self._most)
        # Who is behind by more than a message can hold asks the history.
        missed = [newest + 1 - tick for tick in heard if newest + 1 - tick <= MAX_TOLD_TICKS]
        wanted = min(max(missed, default=UNKNOWN), len(recent), len(self._sizes))
        told, size = 1, rest + self._sizes[-1]
        while told < wanted:
            size += self._sizes[-told - 1]
            if size > DATAGRAM_BYTES or (told >= TOLD_ANYWAY and size > self._saved):
                break
            told += 1
        return told

    def spent(self, size: int) -> None:
        """A message of that many bytes went out."""
        # What the newest ticks cost beyond it is owed, for a while.
        self._saved = max(self._least, self._saved - size)
