"""Patterns of frame times: whole nanoseconds, meeting every quarter of a second."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from kuglice import _core

__all__ = ["PATTERNS", "QUARTER"]

QUARTER = 250_000_000
JITTER = 0.8
"""Of a jittered frame's length, evenly at random, both ways: 3 to 30 ms around 60 per second."""


def _even(rate: int) -> Callable[[int], list[int]]:
    """A rate that 4 divides puts a frame on every quarter."""
    return lambda quarters: [round(i * 1e9 / rate) for i in range(1, quarters * rate // 4 + 1)]


def _jittered(quarters: int) -> list[int]:
    times: list[int] = []
    frames = 15
    for quarter in range(quarters):
        length = 1.0 + JITTER * (2.0 * _core.random_uniform(1, quarter, 0, frames) - 1.0)
        ends = np.cumsum(length) / length.sum()
        times += [quarter * QUARTER + round(float(end) * QUARTER) for end in ends]
    return times


PATTERNS: dict[str, Callable[[int], list[int]]] = {
    "20 fps": _even(20),
    "60 fps": _even(60),
    "144 fps": _even(144),
    "jittered": _jittered,
}
"""Name -> ends of frames in nanoseconds, for a number of quarters of a second."""
