"""A broadphase is how, never what: all of them give the same bits, ball by ball and counter by counter."""

import pytest

import kuglice as kg
from determinism.flying import flight, trail
from determinism.models import named, pairings
from determinism.small_scenes import NAMES, small
from kuglice import _core

TICKS = 240


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("model", pairings("brute"), ids=named)
def test_all_broadphases_agree_with_brute_force(name: str, model: kg.Model) -> None:
    scene = small(name)
    script = flight(scene, TICKS)
    judge = kg.World(scene, model)
    verdict = trail(judge, script)
    others = [broadphase for broadphase in _core.BROADPHASES if broadphase != "brute"]
    assert others
    for broadphase in others:
        world = kg.World(scene, model.model_copy(update={"broadphase": broadphase}))
        assert trail(world, script) == verdict, broadphase
        assert world.snapshot() == judge.snapshot()


@pytest.mark.parametrize("broadphase", ["quadtree", "loose_quadtree"])
@pytest.mark.parametrize("smallest_node", [0.05, 1.0, 7.3, 1000.0])
def test_the_size_of_the_smallest_node_changes_no_bit(broadphase: str, smallest_node: float) -> None:
    scene = small("everything")
    script = flight(scene, TICKS)
    brute = kg.World(scene, kg.Model(broadphase="brute"))
    world = kg.World(scene, kg.Model(broadphase=broadphase, smallest_node=smallest_node))
    assert trail(world, script) == trail(brute, script)


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_full_size_scenes_too(name: str) -> None:
    scene = kg.scenes.TABLE[name]()
    script = flight(scene, 15)
    verdict = trail(kg.World(scene, kg.Model(broadphase="brute")), script)
    for broadphase in _core.BROADPHASES:
        assert trail(kg.World(scene, kg.Model(broadphase=broadphase)), script) == verdict, broadphase
