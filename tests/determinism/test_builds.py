"""Debug or release, x86-64 or AArch64: one state, one hash, tick by tick, while inputs fly."""

from collections.abc import Callable

import pytest

import kuglice as kg
from determinism.flying import flight, trail
from determinism.models import named, pairings
from determinism.small_scenes import NAMES, small
from kuglice import _core
from kuglice.inputs import pack

TICKS = 240
Rerun = Callable[[bytes], list[int]]


@pytest.fixture(params=["debug_build", "release_build", "arm_build"])
def rerun(request: pytest.FixtureRequest) -> Rerun:
    return request.getfixturevalue(request.param)


def compare(rerun: Rerun, world: kg.World) -> None:
    """This Python's own world against another build of the step, from the same recording."""
    script = flight(world.scene, TICKS)
    recording = _core.recording(world._core, [pack(inputs) for inputs in script])
    assert rerun(recording) == trail(world, script)


@pytest.mark.timeout(600)
@pytest.mark.parametrize("name", NAMES)
def test_every_scene_under_its_planned_model(rerun: Rerun, name: str) -> None:
    compare(rerun, kg.World(small(name)))


@pytest.mark.timeout(600)
@pytest.mark.parametrize("model", pairings(), ids=named)
def test_every_pairing_of_methods_with_every_force(rerun: Rerun, model: kg.Model) -> None:
    compare(rerun, kg.World(small("everything"), model))


@pytest.mark.timeout(600)
@pytest.mark.parametrize("broadphase", _core.BROADPHASES)
def test_every_broadphase(rerun: Rerun, broadphase: str) -> None:
    compare(rerun, kg.World(small("everything"), kg.Model(broadphase=broadphase)))
