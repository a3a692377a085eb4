"""How deep balls lie in each other and in the walls."""

from __future__ import annotations

import numpy as np

import kuglice as kg


def depths(world: kg.World) -> np.ndarray:
    """(k,) depth of every overlapping pair, in radii of its smaller ball; pairs of pegs do not count."""
    pairs = world.overlapping().astype(np.intp)
    if len(pairs) == 0:
        return np.zeros(0)
    place = np.searchsorted(world.id, pairs)
    place = place[~np.isinf(world.mass[place]).all(axis=1)]
    first, second = place.T
    between = world.position[second] - world.position[first]
    radius = world.radius
    apart = np.hypot(between[:, 0], between[:, 1])
    return (radius[first] + radius[second] - apart) / np.minimum(radius[first], radius[second])


def deepest(world: kg.World) -> float:
    """In radii; 0 if no pair overlaps."""
    return float(depths(world).max(initial=0.0))


def beyond_walls(world: kg.World) -> float:
    """The farthest that a ball reaches through a wall, as a length; 0 if none does."""
    left, bottom, right, top = world.scene.box
    low = np.array([left, bottom]) + world.radius[:, None]
    high = np.array([right, top]) - world.radius[:, None]
    return float(np.maximum(low - world.position, world.position - high).max(initial=0.0))
