"""How regions are told: how deep the quadtree is, how exact the numbers are, which shapes go by number."""

from __future__ import annotations

import math

import numpy as np

from kuglice import World, _core
from kuglice.protocol import RegionTerms

__all__ = ["choose_terms"]

BALLS_PER_NODE = 128
"""On average, at the most: fewer per message would be mostly envelope, more would be mostly out of sight."""
STEPS_PER_RADIUS = 256
"""Of the smallest ball: a position is then told with an error of at most a 512th of a radius each way."""
STEPS_PER_BOX = 1 << 20
"""Where there is no ball yet that would say how exact to be."""


def choose_terms(world: World, *, rate: float) -> RegionTerms:
    """For a world as it starts; `rate`: times per second that a region is told."""
    scene = world.scene
    players = [] if scene.players is None else [(scene.players.radius, scene.players.mass)]
    shapes = sorted({*_shapes(world), *players})
    if len(shapes) > _core.MOST_SHAPES:
        shapes = players
    left, bottom, right, top = scene.box
    smallest = min([float(world.radius.min(initial=math.inf)), *(radius for radius, _ in shapes)])
    finest = min(right - left, top - bottom) / STEPS_PER_BOX
    quantum = _power_of_two(smallest / STEPS_PER_RADIUS if smallest < math.inf else finest)
    return RegionTerms(
        depth=_depth(max(world.count, len(shapes))),
        rate=rate,
        position_quantum=quantum,
        # Until the next message it adds no more to the error of a position than rounding that did.
        velocity_quantum=_power_of_two(quantum * rate),
        shapes=shapes,
    )


def _depth(balls: int) -> int:
    depth = 1
    while depth < _core.MOST_DEPTH and balls > BALLS_PER_NODE << 2 * depth:
        depth += 1
    return depth


def _power_of_two(most: float) -> float:
    """The largest one that is not above `most`: products with it are exact."""
    return 2.0 ** (math.frexp(most)[1] - 1)


def _shapes(world: World) -> list[tuple[float, float]]:
    radius, mass = world.radius, world.mass
    if not len(radius):
        return []
    if (radius == radius[0]).all() and (mass == mass[0]).all():
        return [(float(radius[0]), float(mass[0]))]
    # As complex numbers, which numpy sorts fast; the product 1j * inf would not be one.
    pairs = np.empty(len(radius), np.complex128)
    pairs.real, pairs.imag = radius, mass
    return [(float(pair.real), float(pair.imag)) for pair in np.unique(pairs)]
