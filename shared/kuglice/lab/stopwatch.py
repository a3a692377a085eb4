"""Timing on a noisy machine: several rounds, all contenders in each, so that they meet the same weather."""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

__all__ = ["Timing", "measure", "race"]

Work = Callable[[], object]
Prepare = Callable[[], Work]


@dataclass(frozen=True)
class Timing:
    """Seconds of each repeat. Noise only ever adds, so the minimum is nearest to the cost of the work."""

    seconds: tuple[float, ...]

    @property
    def minimum(self) -> float:
        """Of all repeats."""
        return min(self.seconds)

    @property
    def median(self) -> float:
        """Of all repeats."""
        return statistics.median(self.seconds)

    @property
    def repeats(self) -> int:
        """How many."""
        return len(self.seconds)


def race(contenders: Mapping[str, Prepare], repeats: int) -> dict[str, Timing]:
    """Each contender prepares its work, unmeasured, and does it; one after the other, round by round."""
    seconds: dict[str, list[float]] = {name: [] for name in contenders}
    for _ in range(repeats):
        for name, prepare in contenders.items():
            seconds[name].append(_timed(prepare()))
    return {name: Timing(tuple(each)) for name, each in seconds.items()}


def measure(prepare: Prepare, repeats: int) -> Timing:
    """One contender alone."""
    return race({"": prepare}, repeats)[""]


def _timed(work: Work) -> float:
    collecting = gc.isenabled()
    gc.disable()
    try:
        start = time.perf_counter()
        work()
        return time.perf_counter() - start
    finally:
        if collecting:
            gc.enable()
