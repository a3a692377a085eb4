"""Broadphases find the same pairs in the hardest scenes of this room: every one of them gives the same bits."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import kuglice as kg
from kuglice import _core
from stability.worlds import make

GRAVITY = (kg.Gravity(0.0, -10.0),)
SWIRL = (kg.Gravity(0.0, -10.0), kg.Attractor(5.0, 5.0, 40.0, 0.5), kg.Drag(0.05))
Maker = Callable[..., kg.World]


def grid(columns: int, rows: int, spacing: float) -> np.ndarray:
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    return spacing * (np.stack([x, y], axis=-1).reshape(-1, 2) + 0.5)


def tunnelling(**model) -> kg.World:
    """Balls that cross the box a hundred times in a tick."""
    velocity = 1e4 * (np.random.default_rng(1).random((16, 2)) - 0.5)
    return make(grid(4, 4, 2.5), velocity, radius=0.2, box=(0, 0, 10, 10), tick_rate=10.0, **model)


def billiard(**model) -> kg.World:
    """Galperin's, 31415 hits in one tick."""
    return make(
        [[1.0, 5.0], [3.0, 5.0]],
        [[0.0, 0.0], [-1.0, 0.0]],
        mass=[1.0, 1e8],
        box=(0, 0, 100, 10),
        tick_rate=0.1,
        **model,
    )


def column(**model) -> kg.World:
    """At rest on each other."""
    return make([[5.0, 0.5], [5.0, 1.5], [5.0, 2.5]], box=(0, 0, 10, 10), forces=GRAVITY, **model)


def bouncing(**model) -> kg.World:
    """Collapses on a floor, balls in a row, each from another height."""
    place = grid(9, 1, 1.1) + np.stack([np.zeros(9), np.arange(9) * 0.7], axis=1)
    return make(place, box=(0, 0, 10, 10), forces=GRAVITY, restitution=0.5, **model)


def heap(**model) -> kg.World:
    """A pile at restitution 0.8."""
    place = grid(8, 8, 0.45) + np.array([0.3, 0.5])
    velocity = np.random.default_rng(2).normal(size=place.shape)
    return make(
        place,
        velocity,
        radius=0.2,
        box=(0, 0, 4.2, 10),
        forces=GRAVITY,
        restitution=0.8,
        tick_rate=120.0,
        **model,
    )


def squeezed(**model) -> kg.World:
    """A light ball between two closing heavy ones."""
    return make(
        [[-3.0, 0.0], [0.0, 0.0], [3.3, 0.0]],
        [[1.0, 0.0], [0.0, 0.0], [-1.0, 0.0]],
        mass=[1e6, 1.0, 1e6],
        restitution=0.5,
        **model,
    )


def one_point(**model) -> kg.World:
    """Fifty balls that start at one point."""
    velocity = np.random.default_rng(3).normal(size=(50, 2))
    return make(np.full((50, 2), 5.0), velocity, radius=0.1, box=(0, 0, 10, 10), allow_overlap=True, **model)


def pack(**model) -> kg.World:
    """A square lattice with gaps of 1 % of a diameter."""
    place = grid(12, 12, 1.01)
    velocity = np.random.default_rng(4).normal(size=place.shape)
    return make(place, velocity, box=(0, 0, 12.12, 12.12), **model)


def sizes(**model) -> kg.World:
    """Radii over a factor of forty, among them one of a third of the box."""
    place = grid(20, 20, 0.5)
    centre = np.array([5.2, 4.7])
    place = place[np.hypot(*(place - centre).T) > 3.55]
    radius = np.geomspace(0.08, 0.24, len(place))
    velocity = np.random.default_rng(5).normal(size=(len(place) + 1, 2))
    return make(
        np.concatenate([[centre], place]),
        velocity,
        radius=[3.3, *radius],
        mass=[100.0, *radius**2],
        box=(0, 0, 10, 10),
        **model,
    )


def kicked(**model) -> kg.World:
    """Gravity, drag and an attractor, floor, pegs and a crowd."""
    place = grid(9, 9, 1.1)
    mass = np.ones(81)
    mass[::17] = math.inf
    velocity = np.random.default_rng(6).normal(size=place.shape) * np.isfinite(mass)[:, None]
    return make(place, velocity, radius=0.4, mass=mass, box=(0, 0, 10, 10), forces=SWIRL, **model)


def board(**model) -> kg.World:
    """Parabolas against pegs."""
    pegs, balls = grid(5, 3, 2.0), grid(9, 3, 1.1) + np.array([0.0, 6.5])
    return make(
        np.concatenate([pegs, balls]),
        radius=[0.3] * 15 + [0.45] * 27,
        mass=[math.inf] * 15 + [1.0] * 27,
        box=(0, 0, 10, 10),
        forces=GRAVITY,
        **model,
    )


HARD: dict[Maker, int] = {
    tunnelling: 2,
    billiard: 2,
    column: 60,
    bouncing: 300,
    heap: 300,
    squeezed: 300,
    one_point: 120,
    pack: 60,
    sizes: 60,
    kicked: 240,
    board: 240,
}
"""Scene -> ticks."""


@pytest.mark.parametrize("contacts", _core.CONTACTS)
@pytest.mark.parametrize("maker", HARD, ids=lambda maker: maker.__name__)
def test_every_broadphase_gives_the_bits_of_brute_force(maker, contacts):
    judge = maker(contacts=contacts, broadphase="brute")
    others = [maker(contacts=contacts, broadphase=name) for name in _core.BROADPHASES if name != "brute"]
    assert len(others) == 2
    for _ in range(10):
        judge.run(HARD[maker] // 10 or 1)
        for world in others:
            world.run(HARD[maker] // 10 or 1)
            assert world.snapshot() == judge.snapshot(), world.model.broadphase
    if contacts == "event" and maker is not column:
        assert judge.collisions + judge.wall_hits > 0


@pytest.mark.parametrize("maker", HARD, ids=lambda maker: maker.__name__)
def test_nothing_of_a_tick_of_event_outlives_it(maker):
    # A world restored at every tick goes the way of one that never was: queue and trees are scratch.
    straight, restored = maker(contacts="event"), maker(contacts="event")
    for _ in range(min(HARD[maker], 60)):
        straight.step()
        restored = kg.World.restore(restored.scene, restored.snapshot(), restored.model)
        restored.step()
    assert restored.snapshot() == straight.snapshot()
