"""`event` says what it goes with and why, before anything runs."""

from __future__ import annotations

import pytest

import kuglice as kg
from kuglice import _core
from kuglice.errors import KugliceError, ModelError


@pytest.mark.parametrize("integrator", [name for name in _core.INTEGRATORS if name != "verlet"])
def test_event_is_refused_with_another_integrator_and_says_why(integrator):
    reason = rf'"event" cannot be paired with integrator "{integrator}", only with verlet: .*parabola.*Verlet'
    with pytest.raises(ModelError, match=reason):
        kg.Model(integrator=integrator, contacts="event")
    with pytest.raises(ModelError, match=reason):
        _core.Model(integrator=integrator, contacts="event", broadphase="brute")


@pytest.mark.parametrize("integrator", [name for name in _core.INTEGRATORS if name != "verlet"])
def test_pinned_in_a_scene_it_is_refused_as_well(integrator):
    with pytest.raises(KugliceError, match=rf"{integrator}.*verlet|verlet.*{integrator}"):
        kg.plan(kg.Scene(box=(0, 0, 1, 1), model=kg.ModelPins(integrator=integrator, contacts="event")))


@pytest.mark.parametrize("broadphase", _core.BROADPHASES)
@pytest.mark.parametrize("substeps", [1, 4])
def test_event_goes_with_verlet_and_any_broadphase(broadphase, substeps):
    scene = kg.scenes.gas(n=50)
    world = kg.World(scene, kg.Model(contacts="event", broadphase=broadphase, substeps=substeps))
    energy = world.energy
    world.run(60)
    assert world.energy == pytest.approx(energy, rel=1e-13)


def test_substeps_of_event_change_rounding_only():
    # Between hits the path is exact, so a cut tick differs by rounding that few collisions have magnified.
    scene = kg.scenes.gas(n=50)
    whole, parted = (kg.World(scene, kg.Model(contacts="event", substeps=substeps)) for substeps in (1, 8))
    whole.run(10)
    parted.run(10)
    assert whole.collisions == parted.collisions > 0
    assert parted.position == pytest.approx(whole.position, abs=1e-9)
