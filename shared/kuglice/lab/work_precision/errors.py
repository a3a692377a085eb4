"""Four errors, because one is not enough: a method may keep the energy and lose every ball."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from kuglice.lab.energy import energy
from kuglice.lab.running import Running
from kuglice.model import Model
from kuglice.scene import Scene
from kuglice.world import World

__all__ = ["deepest_overlap", "long_run", "position_error", "seen"]

Floats = NDArray[np.float64]

SAMPLES_PER_SECOND = 10


def position_error(position: Floats, right: Floats, radius: Floats) -> float:
    """Root mean square over balls of the distance from where they should be, in radii."""
    apart = ((position - right) ** 2).sum(1) / (radius * radius)
    return float(np.sqrt(apart.mean()))


def deepest_overlap(position: Floats, radius: Floats) -> float:
    """How deep the worst pair overlaps, in radii of the smaller ball. Every pair is looked at."""
    one, two = np.triu_indices(len(radius), 1)
    if not len(one):
        return 0.0
    apart = position[two] - position[one]
    depth = radius[one] + radius[two] - np.sqrt((apart * apart).sum(1))
    return max(0.0, float((depth / np.minimum(radius[one], radius[two])).max()))


def long_run(scene: Scene, running: Running, seconds: float) -> tuple[float, float]:
    """Largest relative drift of energy and deepest overlap, sampled ten times a second."""
    start = energy(scene, running)
    ticks = max(1, round(scene.tick_rate / SAMPLES_PER_SECOND))
    drift = depth = 0.0
    for _ in range(round(seconds * scene.tick_rate / ticks)):
        running.run(ticks)
        drift = max(drift, abs(energy(scene, running) / start - 1.0))
        depth = max(depth, deepest_overlap(running.position, scene.balls.radius))
    return drift, depth


def seen(scene: Scene, models: Mapping[str, Model], right: World, ticks: int) -> tuple[dict[str, int], int]:
    """Collisions that each model sees, and those that there are; each tick from the right state."""
    counts = dict.fromkeys(models, 0)
    before = right.collisions
    for _ in range(ticks):
        now, met = right.snapshot(), right.collisions
        for name, model in models.items():
            world = World.restore(scene, now, model)
            world.step()
            counts[name] += world.collisions - met
        right.step()
    return counts, right.collisions - before
