"""Crowds: `overlap` lets them sink under gravity and press into each other, `event` keeps every disc hard."""

from __future__ import annotations

import math

import numpy as np
import pytest

import kuglice as kg
from stability.overlaps import beyond_walls, deepest, depths
from stability.worlds import make

ROUNDING = 1e-12
"""Depth in radii that `event` may leave."""


def rain(contacts: str, seed: int) -> tuple[float, float, float]:
    """Mean height, deepest pair, and pairs half a radius deep per ball, over the seconds 2 to 10."""
    scene = kg.scenes.rain(n=2000, seed=seed)
    world = kg.World(scene, kg.Model(integrator="verlet", contacts=contacts))
    energy = world.energy
    world.run(240)
    height, worst, share = [], 0.0, []
    for _ in range(32):
        world.run(15)
        found = depths(world)
        worst = max(worst, float(found.max(initial=0.0)))
        share.append((found > 0.5).sum() / world.count)
        height.append(world.position[:, 1].mean())
    # Verlet is exact under gravity and exchanges are exact: energy cannot tell the three treatments apart.
    assert world.energy == pytest.approx(energy, rel=1e-12)
    return float(np.mean(height)), worst, float(np.mean(share))


@pytest.mark.parametrize("seed", [1, 2])
def test_rain_sinks_with_overlap_less_with_backtrack_not_with_event(seed):
    low, deep, many = rain("overlap", seed)
    middle, _, fewer = rain("backtrack", seed)
    high, none, zero = rain("event", seed)
    assert low < middle < high
    assert many > fewer > zero == 0.0
    # Two radii is as deep as a pair of equal balls can be.
    assert deep > 1.5
    assert none < ROUNDING


def pile(contacts: str) -> kg.World:
    """200 balls at restitution 0.8, six seconds after they began to fall."""
    scene = kg.scenes.rain(n=200)
    group = scene.groups[0].model_copy(update={"area": (0.0, 1.0, 8.0, 14.0)})
    scene = kg.Scene(
        box=(0, 0, 8, 14), tick_rate=120, restitution=0.8, forces=scene.forces, groups=[group.model_dump()]
    )
    world = kg.World(scene, kg.Model(integrator="verlet", contacts=contacts))
    energy = world.energy
    for _ in range(720):
        world.step()
        assert world.energy <= energy + 1e-10
        energy = world.energy
    return world


def densest(world: kg.World) -> float:
    """Mean height of the densest packing, which takes 2 sqrt(3) r^2 per disc and is twice as high."""
    left, _, right, _ = world.scene.box
    return float((2 * math.sqrt(3) * world.radius**2).sum() / (right - left) / 2)


@pytest.mark.parametrize("contacts", ["overlap", "backtrack"])
def test_an_inelastic_pile_sinks_below_the_densest_packing(contacts):
    world = pile(contacts)
    assert world.position[:, 1].mean() < 0.9 * densest(world)
    assert deepest(world) > 1.0


def test_an_inelastic_pile_of_event_lies_on_its_own_balls():
    world = pile("event")
    assert 1.0 < world.position[:, 1].mean() / densest(world) < 1.2
    assert deepest(world) < ROUNDING
    assert beyond_walls(world) < ROUNDING


COLUMNS = 20


def pack(contacts: str) -> kg.World:
    """390 discs at packing 0.85 between walls: a hexagonal lattice with gaps of 0.03 radii."""
    radius = 0.5
    # Packing of the lattice alone, walls take the rest: pi r^2 / (spacing^2 sqrt(3) / 2) = 0.88.
    spacing = math.sqrt(math.pi * radius**2 / (0.88 * math.sqrt(3) / 2))
    row, column = np.divmod(np.arange(COLUMNS * COLUMNS), COLUMNS)
    kept = (row % 2 == 0) | (column < COLUMNS - 1)
    row, column = row[kept], column[kept]
    position = spacing / 2 + spacing * np.stack([column + 0.5 * (row % 2), row * math.sqrt(3) / 2], axis=1)
    box = (0.0, 0.0, *(position.max(axis=0) + spacing / 2))
    packing = len(position) * math.pi * radius**2 / (box[2] * box[3])
    assert packing == pytest.approx(0.85, abs=0.005)
    velocity = np.random.default_rng(1).normal(size=position.shape)
    return make(position, velocity, radius=radius, box=box, contacts=contacts)


@pytest.mark.parametrize("contacts", ["overlap", "backtrack"])
def test_a_pack_at_085_is_pressed_into_itself(contacts):
    world = pack(contacts)
    energy, worst = world.energy, 0.0
    for _ in range(120):
        world.step()
        worst = max(worst, deepest(world))
    assert worst > 0.3
    assert world.energy == pytest.approx(energy, rel=1e-12)


def test_a_pack_at_085_stays_hard_with_event():
    world = pack("event")
    energy = world.energy
    for _ in range(120):
        world.step()
        assert deepest(world) < ROUNDING
        assert beyond_walls(world) < ROUNDING
    assert world.energy == pytest.approx(energy, rel=1e-12)
    # Caged: two seconds at unit speed, and nobody has changed places.
    assert world.collisions > 50 * world.count
    assert np.abs(world.position - world.scene.balls.position).max() < 1.0


@pytest.mark.parametrize("restitution", [0.0, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_balls_drawn_together_between_kicks_overlap_by_a_fall_of_one_tick_at_most(restitution, seed):
    # A force of place is a kick per tick: what rests is held on straight paths, which leave the true ones by
    # a h^2 / 2. The pull is largest at softening / sqrt(2): s 2 / (3 sqrt(3) softening^2), plus gravity.
    strength, softening, tick_rate = 20.0, 0.5, 60.0
    pull = strength * 2 / (3 * math.sqrt(3) * softening**2)
    random = np.random.default_rng(seed)
    place = np.stack([random.uniform(0.5, 3.5, 5), 0.5 + 1.1 * np.arange(5)], axis=1)
    world = make(
        place,
        random.normal(size=(5, 2)),
        radius=0.4,
        mass=random.uniform(0.1, 10, 5),
        box=(0, 0, 4, 8),
        forces=[kg.Gravity(0.0, -10.0), kg.Attractor(2.0, 1.0, strength, softening)],
        restitution=restitution,
        tick_rate=tick_rate,
    )
    fall = (pull + 10.0) / tick_rate**2 / 2
    for _ in range(600):
        world.step()
        assert deepest(world) * 0.4 < fall
        assert beyond_walls(world) < fall
