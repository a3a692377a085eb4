"""How it feels to play: what a person at the screen would notice, measured while playing."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

__all__ = ["Feel"]

KEPT_INPUTS = 65_536
SILENCE_SECONDS = 1.0


class _Unseen(NamedTuple):
    sequence: int
    tick: int
    at: float
    frame: int


@dataclass
class Feel:
    """Of one client, over all runs of the server that it lives through. Times are in seconds.

    `recovery`: for each silence of a second or more, from the first message after it until the confirmed
    world had done all that the stream told; `recovered_at`: when that was. Who knows when the link was back, as a
    bench does, can tell how long all of it took.
    """

    inputs: int = 0
    recovery: list[float] = field(default_factory=list)
    recovered_at: list[float] = field(default_factory=list)
    _frame: int = 0
    _unseen: deque[_Unseen] = field(default_factory=deque)
    _delays: deque[float] = field(default_factory=lambda: deque(maxlen=KEPT_INPUTS))
    _frames: deque[int] = field(default_factory=lambda: deque(maxlen=KEPT_INPUTS))
    _heard_at: float | None = None
    _back_at: float | None = None

    def acted(self, sequence: int, tick: int, at: float) -> None:
        """An own input was made at `at`, to act in `tick`."""
        self.inputs += 1
        self._unseen.append(_Unseen(sequence, tick, at, self._frame))

    def shown(self, state: int, at: float) -> list[tuple[int, int]]:
        """A frame with state(`state`) is drawn: sequence and tick of own inputs that it is the first to show."""
        self._frame += 1
        seen = []
        while self._unseen and self._unseen[0].tick < state:
            one = self._unseen.popleft()
            self._delays.append(at - one.at)
            self._frames.append(self._frame - one.frame)
            seen.append((one.sequence, one.tick))
        return seen

    def heard(self, at: float) -> None:
        """The stream brought something."""
        if self._heard_at is not None and at - self._heard_at >= SILENCE_SECONDS:
            self._back_at = at
        self._heard_at = at

    def caught_up(self, at: float) -> None:
        """The confirmed world has done everything that the stream told."""
        if self._back_at is not None:
            self.recovery.append(at - self._back_at)
            self.recovered_at.append(at)
            self._back_at = None

    def entered(self) -> None:
        """Another run of the server: what was not seen yet never will be."""
        self._unseen.clear()

    def own_input_delay(self) -> dict[str, float | None]:
        """From acting to the first frame that shows it, in milliseconds and in frames; None without inputs."""
        if not self._delays:
            return {"mean": None, "p99": None, "mean_frames": None, "worst_frames": None}
        delays = 1000 * np.asarray(self._delays)
        return {
            "mean": float(delays.mean()),
            "p99": float(np.percentile(delays, 99)),
            "mean_frames": float(np.mean(self._frames)),
            "worst_frames": max(self._frames),
        }
