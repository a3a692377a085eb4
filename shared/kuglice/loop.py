"""Loops: how real time becomes ticks. All of them take any clock that counts nanoseconds.

    loop = Fixed(world, inputs=lambda world: [...])
    while running:
        frame = loop.frame()          # steps the world as often as time asks for
        draw(world, frame.alpha)

A frame that took longer than `longest` is cut to it. What is cut is never made up for: the world runs slow
for that moment, and the loop counts it, reports it in the frame and logs it. For Fixed and Interpolated, the
bits at a tick do not depend on how time was cut into frames.
"""

from __future__ import annotations

import logging
import math
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kuglice.blending import blend
from kuglice.errors import LimitError
from kuglice.inputs import Input
from kuglice.world import World

__all__ = ["Clock", "Fixed", "Frame", "Inputs", "Interpolated", "Variable"]

Clock = Callable[[], int]
Inputs = Callable[[World], Iterable[Input]]

SECOND = 1_000_000_000
LONGEST = 0.25

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Frame:
    """What one call of `frame` did."""

    ticks: int
    alpha: float
    """Fraction of a tick, in [0, 1), that has passed since the world's state; 0 for a variable step."""
    elapsed: float
    """Seconds since the frame before."""
    skipped: float
    """Seconds of them that were cut, because the frame took longer than the longest allowed."""


class Loop(ABC):
    """Reads the clock once per frame. `inputs` is asked before every tick."""

    def __init__(
        self,
        world: World,
        *,
        inputs: Inputs | None = None,
        clock: Clock = time.monotonic_ns,
        longest: float = LONGEST,
    ) -> None:
        if not 0 < longest < math.inf:
            raise LimitError(f"longest = {longest}: must be finite and greater than 0 seconds")
        self.world = world
        self.stalls = 0
        """Frames that were cut."""
        self.skipped = 0.0
        """Seconds cut in total."""
        self._inputs = inputs
        self._clock = clock
        self._longest = round(longest * SECOND)
        self._last = clock()
        self._begin()

    def _begin(self) -> None:  # noqa: B027 - a loop may need nothing of its own
        """What a kind of loop needs of its own, once the world is there."""

    def frame(self) -> Frame:
        """Bring the world up to now."""
        now = self._clock()
        # A clock that is set back must not make time run backwards.
        elapsed = max(now - self._last, 0)
        self._last = now
        used = min(elapsed, self._longest)
        skipped = (elapsed - used) / SECOND
        if skipped:
            self.stalls += 1
            self.skipped += skipped
            log.warning("stall: a frame took %.3f s, %.3f s of it are skipped", elapsed / SECOND, skipped)
        ticks, alpha = self._advance(used)
        return Frame(ticks, alpha, elapsed / SECOND, skipped)

    @abstractmethod
    def _advance(self, nanoseconds: int) -> tuple[int, float]:
        """Step the world; ticks done and alpha."""

    def _step(self, dt: float | None = None) -> None:
        self.world.step(() if self._inputs is None else self._inputs(self.world), dt)


class Variable(Loop):
    """One step per frame, as long as the frame: simple, and never the same twice."""

    def _advance(self, nanoseconds: int) -> tuple[int, float]:
        if not nanoseconds:
            return 0, 0.0
        self._step(nanoseconds / SECOND)
        return 1, 0.0


class Fixed(Loop):
    """Steps of 1 / tick_rate; the time that is left over waits in an accumulator."""

    def _begin(self) -> None:
        super()._begin()
        # Nanoseconds times the rate's numerator: whole numbers, so that no split of time rounds differently.
        self._scale, denominator = self.world.scene.tick_rate.as_integer_ratio()
        self._tick = SECOND * denominator
        self._waiting = 0

    def _advance(self, nanoseconds: int) -> tuple[int, float]:
        self._waiting += nanoseconds * self._scale
        ticks, self._waiting = divmod(self._waiting, self._tick)
        for left in range(ticks, 0, -1):
            self._before_step(left)
            self._step()
        return ticks, self._alpha()

    def _alpha(self) -> float:
        # The quotient of two large whole numbers may round up to 1, which belongs to the next tick.
        return min(self._waiting / self._tick, 1.0 - 2.0**-53)

    def _before_step(self, left: int) -> None:
        """`left` steps remain in this frame."""


class Interpolated(Fixed):
    """Fixed steps, drawn between the last two states, one tick late and without jerks."""

    def _begin(self) -> None:
        super()._begin()
        self.previous = self.world.clone()
        """The state one tick ago: a copy."""

    def _before_step(self, left: int) -> None:
        if left == 1:
            self.previous.copy_from(self.world)

    @property
    def position(self) -> NDArray[np.float64]:
        """(n, 2) in the world's id order: alpha current + (1 - alpha) previous; new balls where they are."""
        before, now = self.previous, self.world
        return blend(before.id, before.position, now.id, now.position, self._alpha())
