"""What the four errors say of states that are known."""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from kuglice.lab.energy import conserved, energy
from kuglice.lab.methods import Method
from kuglice.lab.reference import reference
from kuglice.lab.work_precision.errors import deepest_overlap, long_run, position_error, seen


def test_position_error_is_in_radii():
    right = np.zeros((2, 2))
    wrong = np.array([[3.0, 4.0], [0.0, 0.0]])
    assert position_error(wrong, right, np.array([5.0, 1.0])) == pytest.approx(np.sqrt(0.5))


def test_deepest_overlap_is_in_radii_of_the_smaller_ball():
    position = np.array([[0.0, 0.0], [2.5, 0.0], [9.0, 9.0]])
    assert deepest_overlap(position, np.array([2.0, 1.0, 1.0])) == pytest.approx(0.5)
    assert deepest_overlap(position, np.array([1.0, 1.0, 1.0])) == 0.0
    assert deepest_overlap(position[:1], np.array([1.0])) == 0.0


def test_energy_is_the_worlds_own():
    scene = kg.scenes.gas(n=20).model_copy(
        update={"forces": (kg.Gravity(0.5, -2.0), kg.Attractor(3.0, 3.0, 5.0, 0.7), kg.Spring(1.0, 2.0, 0.3))}
    )
    world = kg.World(scene)
    world.run(10)
    assert energy(scene, world) == pytest.approx(world.energy)
    assert conserved(scene)
    assert not conserved(scene.model_copy(update={"forces": (kg.Drag(0.1),)}))


def test_event_contacts_neither_drift_nor_overlap():
    scene = kg.scenes.gas(n=50)
    drift, depth = long_run(scene, kg.World(scene, Method("verlet", "event").model()), 5.0)
    assert drift < 1e-12
    assert depth < 1e-12


def test_overlap_misses_fast_pairs_and_event_none():
    scene = kg.scenes.gas(n=100).model_copy(update={"tick_rate": 20.0})
    models = {contacts: Method("verlet", contacts).model() for contacts in ("overlap", "event")}
    counts, there = seen(scene, models, reference(scene), 20)
    assert counts["event"] == there > 0
    assert counts["overlap"] < 0.95 * there
