"""Can this machine follow a world at all, and go ahead of it? Measured once, on joining."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from kuglice import World
from kuglice.budget import tick_budget
from kuglice.errors import JoinError, StepError
from kuglice.wording import of_many

__all__ = ["judge_pace", "step_seconds"]

log = logging.getLogger(__name__)

STEPS = 8
SECONDS = 0.2
PREDICTING = 2.0
"""Times real time that a step must run at: as often as the stream moves on, running forward again comes on top."""


def step_seconds(world: World, clock: Callable[[], float] = time.perf_counter) -> float:
    """The least that a tick of a copy of `world` takes, of a few or of 0.2 s, whichever is over first."""
    copy = world.clone()
    least, began = float("inf"), clock()
    for _ in range(STEPS):
        before = clock()
        try:
            copy.step(budget=tick_budget(copy))
        except StepError:
            # Not a matter of speed; the stream will tell what becomes of this tick.
            break
        least = min(least, clock() - before)
        if clock() - began > SECONDS:
            break
    return least if least < float("inf") else 0.0


def judge_pace(seconds: float, *, rate: float, balls: int) -> None:
    """Warn who cannot predict at `rate` ticks per second with steps of `seconds`.

    Raises JoinError for who cannot even follow.
    """
    speed = 1.0 / (seconds * rate) if seconds > 0 else float("inf")
    if speed >= PREDICTING:
        return
    told = (
        f"a tick of {balls} {of_many(balls, 'ball')} takes {1000 * seconds:.3g} ms on this machine, the server makes "
        f"one every {1000 / rate:.3g} ms: {speed:.2g} times real time"
    )
    if speed < 1.0:
        raise JoinError(f"{told}, at least 1 needed to follow: look at a part of it with `kuglice view`")
    log.warning(
        "%s, at least %g needed to predict: better look at a part of it with `kuglice view`", told, PREDICTING
    )
