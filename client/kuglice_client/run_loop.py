"""The loop that clients and views run in: a turn, the frames that are due after it, a short rest."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable

__all__ = ["FRAME_RATE", "Frames", "run_loop"]

IDLE_SECONDS = 0.002
FRAME_RATE = 60.0
"""Of a screen that nobody looks at: what is seen is counted per frame, so there must be some."""


class Frames:
    """When frames are due: `rate` times per second, None for a screen that nobody looks at.

    A screen leaves out those that it has no time for; what asks for a rate, as a film does, has all of them.
    """

    def __init__(self, rate: float | None) -> None:
        self._rate = FRAME_RATE if rate is None else rate
        self._all = rate is not None
        self._drawn = 0

    def due(self, played: float) -> int:
        """How many are to be drawn after that many seconds of play."""
        # The first one is due once time has passed at all.
        until = math.ceil(played * self._rate)
        due, self._drawn = max(0, until - self._drawn), max(until, self._drawn)
        return due if self._all else min(1, due)


def run_loop(
    turn: Callable[[float], float],
    frame: Callable[[float], None],
    frames: Frames,
    *,
    stop: threading.Event,
    seconds: float | None,
) -> None:
    """Until `stop`, or for that many seconds (None: no end): `turn(now)` gives alpha, and `frame(alpha)` draws it."""
    begin = time.monotonic()
    while not stop.is_set():
        now = time.monotonic()
        alpha = turn(now)
        played = now - begin if seconds is None else min(now - begin, seconds)
        for _ in range(frames.due(played)):
            frame(alpha)
        if seconds is not None and now - begin >= seconds:
            break
        stop.wait(IDLE_SECONDS)
