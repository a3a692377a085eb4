"""Balls that start in each other: no method can be right, but each ends, stays finite and keeps the energy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kuglice as kg
from stability.overlaps import deepest
from stability.worlds import make

CONTACTS = ["overlap", "backtrack", "event"]
BOX = (0.0, 0.0, 10.0, 10.0)


@pytest.mark.parametrize("contacts", CONTACTS)
def test_a_receding_pair_is_left_alone(contacts):
    # Bannerman et al. 2011, arXiv 1211.6718: overlapping and receding is no collision.
    world = make([[0.0, 0.0], [0.3, 0.0]], [[-1.0, 0.0], [1.0, 0.0]], allow_overlap=True, contacts=contacts)
    world.run(120)
    assert world.collisions == 0
    assert world.velocity.tolist() == [[-1.0, 0.0], [1.0, 0.0]]


@pytest.mark.parametrize("contacts", CONTACTS)
def test_an_approaching_pair_collides_at_once(contacts):
    world = make([[0.0, 0.0], [0.6, 0.0]], [[1.0, 0.0], [-1.0, 0.0]], allow_overlap=True, contacts=contacts)
    world.step()
    assert world.collisions == 1
    assert world.velocity.tolist() == [[-1.0, 0.0], [1.0, 0.0]]
    world.run(60)
    assert world.collisions == 1
    assert len(world.overlapping()) == 0


@pytest.mark.parametrize("contacts", CONTACTS)
def test_centres_at_one_point_have_a_normal(contacts):
    # Coincident centres part along x, the lower id to the left (contacts/exchange.rs).
    world = make([[0.0, 0.0], [0.0, 0.0]], [[1.0, 0.5], [-1.0, 0.5]], allow_overlap=True, contacts=contacts)
    world.run(120)
    assert np.isfinite(world.position).all()
    assert sorted(world.velocity[:, 0].tolist()) == [-1.0, 1.0]
    assert world.velocity[:, 1].tolist() == [0.5, 0.5]
    assert len(world.overlapping()) == 0


@pytest.mark.parametrize("contacts", CONTACTS)
@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_a_hundred_balls_at_one_point(contacts, restitution):
    velocity = np.random.default_rng(5).normal(size=(100, 2))
    world = make(
        np.full((100, 2), 5.0),
        velocity,
        radius=0.1,
        box=BOX,
        restitution=restitution,
        allow_overlap=True,
        contacts=contacts,
    )
    energy, momentum = world.energy, world.momentum
    world.step()
    assert world.momentum == pytest.approx(momentum, abs=1e-11)
    for _ in range(300):
        before = world.energy
        world.step()
        assert world.energy <= before * (1 + 1e-12)
    if restitution == 1.0:
        assert world.energy == pytest.approx(energy, rel=1e-12)
    assert np.isfinite(world.position).all()


def test_event_undoes_a_start_at_one_point_and_stays_hard():
    velocity = np.random.default_rng(5).normal(size=(100, 2))
    world = make(np.full((100, 2), 5.0), velocity, radius=0.1, box=BOX, allow_overlap=True)
    world.run(1200)
    assert deepest(world) < 1e-9
    deep = []
    for _ in range(100):
        world.step()
        deep.append(deepest(world))
    assert max(deep) < 1e-9


def test_a_heap_at_one_point_and_at_rest_falls_as_one():
    # Nothing approaches anything, so nothing ever collides but with the floor.
    world = make(
        np.full((10, 2), 5.0), radius=0.1, box=BOX, forces=[kg.Gravity(0.0, -10.0)], allow_overlap=True
    )
    energy = world.energy
    world.run(300)
    assert (world.position == world.position[0]).all()
    assert world.energy == pytest.approx(energy, rel=1e-12)
    assert world.collisions == 0
    # Every ball bounces with period 2 sqrt(2 d / g), the first time after half of it; d = 4.9.
    assert world.wall_hits == 10 * round(5 / (2 * math.sqrt(2 * 4.9 / 10)))


@settings(max_examples=40)
@given(seed=st.integers(0, 2**32), restitution=st.floats(0, 1), packing=st.floats(0.3, 0.7))
def test_any_crowded_start_ends_in_finite_work(seed, restitution, packing):
    random = np.random.default_rng(seed)
    radius = random.uniform(0.1, 0.6, size=60)
    side = math.sqrt(math.pi * (radius**2).sum() / packing)
    position = radius[:, None] + random.uniform(size=(60, 2)) * (side - 2 * radius[:, None])
    for contacts in CONTACTS:
        world = make(
            position,
            random.normal(size=(60, 2)),
            radius=radius,
            mass=radius**2,
            box=(0, 0, side, side),
            restitution=restitution,
            allow_overlap=True,
            contacts=contacts,
        )
        energy = world.energy
        world.run(60)
        assert world.energy <= energy * (1 + 1e-12)
