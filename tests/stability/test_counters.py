"""Collisions and wall hits are part of the state: exact, and as before after a snapshot."""

from __future__ import annotations

import math

import pytest

import kuglice as kg
from stability.worlds import make

CONTACTS = ["overlap", "backtrack", "event"]


@pytest.mark.parametrize("contacts", CONTACTS)
def test_a_ball_in_a_box_hits_walls_as_often_as_it_crosses(contacts):
    # Free length 9 in x at speed 3, 4 in y at speed 2, from the lower left corner.
    world = make([[0.5, 0.5]], [[3.0, 2.0]], box=(0, 0, 10, 5), contacts=contacts)
    world.run(100 * 60 + 1)
    assert world.wall_hits == pytest.approx(100 * 3 / 9 + 100 * 2 / 4, abs=2)
    assert world.collisions == 0


@pytest.mark.parametrize("contacts", CONTACTS)
def test_a_pair_counts_once_and_a_peg_counts_too(contacts):
    world = make([[0.0, 0.0], [1.1, 0.0]], [[1.0, 0.0], [0.0, 0.0]], contacts=contacts)
    world.run(60)
    assert (world.collisions, world.wall_hits) == (1, 0)
    world = make([[0.0, 0.0], [1.1, 0.0]], [[1.0, 0.0], [0.0, 0.0]], mass=[1.0, math.inf], contacts=contacts)
    world.run(60)
    assert (world.collisions, world.wall_hits) == (1, 0)


@pytest.mark.parametrize("contacts", CONTACTS)
@pytest.mark.parametrize("name", ["gas:n=100,packing=0.4", "rain:n=100", "mixed:n=60"])
def test_counters_survive_a_snapshot_and_go_on(contacts, name):
    scene = kg.scenes.find(name)
    model = kg.Model(integrator="verlet", contacts=contacts)
    world = kg.World(scene, model)
    world.run(300)
    counted = (world.collisions, world.wall_hits)
    assert min(counted) > 0
    restored = kg.World.restore(scene, world.snapshot(), model)
    assert (restored.collisions, restored.wall_hits) == counted
    world.run(120)
    restored.run(120)
    assert (restored.collisions, restored.wall_hits) == (world.collisions, world.wall_hits)
    assert world.collisions > counted[0]
    assert restored.snapshot() == world.snapshot()
