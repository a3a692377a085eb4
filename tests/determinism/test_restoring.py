"""Nothing carries over from tick to tick but the state: save anywhere, go on, and the bits are the same."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kuglice as kg
from determinism.flying import flight, trail
from determinism.models import named, pairings
from determinism.small_scenes import NAMES, small

TICKS = 240
ROLLBACK = 7


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=5)
@given(at=st.integers(0, TICKS), seed=st.integers(0, 2**32))
def test_restored_at_any_tick_a_world_goes_on_as_if_nothing_had_been(name: str, at: int, seed: int) -> None:
    scene = small(name)
    script = flight(scene, TICKS, seed)
    world = kg.World(scene)
    trail(world, script[:at])
    restored = kg.World.restore(scene, world.snapshot(), model=world.model)
    assert restored.state_hash == world.state_hash
    assert trail(restored, script[at:]) == trail(world, script[at:])
    assert restored.snapshot() == world.snapshot()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("model", pairings(), ids=named)
def test_every_tick_saved_rolled_back_and_run_again(name: str, model: kg.Model) -> None:
    """A sync test: what a rollback does at a bad moment is done here at every moment."""
    scene = small(name)
    world = kg.World(scene, model)
    for inputs in flight(scene, TICKS):
        before = world.snapshot()
        world.step(inputs)
        again = kg.World.restore(scene, before, model=model)
        assert again.snapshot() == before
        again.step(inputs)
        assert again.state_hash == world.state_hash, f"tick {world.tick}"
        assert again.snapshot() == world.snapshot(), f"tick {world.tick}"


@pytest.mark.parametrize("name", NAMES)
def test_worlds_that_copy_each_other_for_rollback_stay_equal(name: str) -> None:
    scene = small(name)
    script = flight(scene, TICKS)
    confirmed, predicted = kg.World(scene), kg.World(scene)
    for first in range(0, TICKS, ROLLBACK):
        # A prediction that lacks the inputs, which leaves its caches in a state of its own.
        predicted.run(ROLLBACK)
        predicted.copy_from(confirmed)
        clone = confirmed.clone()
        expected = trail(confirmed, script[first : first + ROLLBACK])
        assert trail(predicted, script[first : first + ROLLBACK]) == expected
        assert trail(clone, script[first : first + ROLLBACK]) == expected


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_full_size_scenes_too(name: str) -> None:
    scene = kg.scenes.TABLE[name]()
    world = kg.World(scene)
    for inputs in flight(scene, 20):
        before = world.snapshot()
        world.step(inputs)
        again = kg.World.restore(scene, before, model=world.model)
        again.step(inputs)
        assert again.snapshot() == world.snapshot(), f"tick {world.tick}"
