"""Orders of convergence on smooth forces: 1, 1, 2, 4, whatever would treat contacts if there were any."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import kuglice as kg
from stability.orders import order
from stability.worlds import make

ORDERS = {
    ("euler", "overlap"): 1,
    ("symplectic_euler", "overlap"): 1,
    ("verlet", "overlap"): 2,
    ("verlet", "backtrack"): 2,
    ("verlet", "event"): 2,
    ("rk4", "overlap"): 4,
}
DURATION = 2.0
TICKS = [128, 256, 512, 1024]


def spring(t: float) -> list[float]:
    """m x'' = -k x with k / m = 4: x0 cos 2t + v0 / 2 sin 2t."""
    return [math.cos(2 * t), 0.5 * math.sin(2 * t)]


def damped(t: float) -> list[float]:
    """m x'' = -k x - c v with k = 4, c = m = 1: e^(-t/2) (x0 cos wt + (v0 + x0/2) / w sin wt), w^2 = 15/4."""
    w = math.sqrt(4 - 0.25)
    decay = math.exp(-t / 2)
    return [
        decay * (math.cos(w * t) + 0.5 / w * math.sin(w * t)),
        decay * math.sin(w * t) / w,
    ]


def circle(t: float) -> list[float]:
    """Circular orbit in a softened well: w^2 = s / (r^2 + e^2)^(3/2); s = 8, r^2 = 1, e^2 = 3 give w = 1."""
    return [math.cos(t), math.sin(t)]


FORCES: dict[str, tuple[list[object], Callable[[float], list[float]]]] = {
    "spring": ([kg.Spring(0.0, 0.0, 4.0)], spring),
    "spring and drag": ([kg.Spring(0.0, 0.0, 4.0), kg.Drag(1.0)], damped),
    "softened attractor": ([kg.Attractor(0.0, 0.0, 8.0, math.sqrt(3))], circle),
}
"""Forces and the exact path of a ball that starts at (1, 0) with velocity (0, 1)."""


@pytest.mark.parametrize("force", FORCES)
@pytest.mark.parametrize(("integrator", "contacts"), ORDERS)
def test_order(integrator, contacts, force):
    forces, exact = FORCES[force]
    errors = []
    for ticks in TICKS:
        world = make(
            [[1.0, 0.0]],
            [[0.0, 1.0]],
            forces=forces,
            tick_rate=ticks / DURATION,
            integrator=integrator,
            contacts=contacts,
        )
        world.run(ticks)
        errors.append(np.abs(world.position[0] - exact(DURATION)).max())
    assert order(TICKS, errors) == pytest.approx(ORDERS[integrator, contacts], abs=0.1)


@pytest.mark.parametrize("integrator", ["euler", "symplectic_euler", "verlet", "rk4"])
def test_substeps_are_shorter_ticks(integrator):
    def moved(tick_rate: float, substeps: int, ticks: int) -> kg.World:
        world = make(
            [[1.0, 0.0]],
            [[0.0, 1.0]],
            forces=[kg.Spring(0.0, 0.0, 4.0)],
            tick_rate=tick_rate,
            substeps=substeps,
            integrator=integrator,
            contacts="overlap",
        )
        world.run(ticks)
        return world

    cut, short = moved(64.0, 8, 100), moved(512.0, 1, 800)
    assert (cut.position == short.position).all()
    assert (cut.velocity == short.velocity).all()
