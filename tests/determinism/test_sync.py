"""A sync test, after GGRS: every tick of every scene is saved, rolled back by 1 to 24 ticks, run again, compared."""

from __future__ import annotations

from collections import deque

import pytest

import kuglice as kg
from determinism.flying import flight
from determinism.models import named, pairings
from determinism.small_scenes import NAMES, small

TICKS = 72
DEEPEST = 24
SEED = 24


def rolled_back_everywhere(scene: kg.Scene, model: kg.Model | None, depths: range) -> int:
    """Run the scene with inputs flying; after each tick go back by each of `depths`, and again. Returns comparisons."""
    world = kg.World(scene, model)
    again = world.clone()
    script = flight(scene, TICKS, SEED)
    saved: deque[bytes] = deque([world.snapshot()], maxlen=depths.stop)
    copies: deque[kg.World] = deque([world.clone()], maxlen=depths.stop)
    hashes = [world.state_hash]
    compared = 0
    for inputs in script:
        world.step(inputs)
        saved.append(world.snapshot())
        copies.append(world.clone())
        hashes.append(world.state_hash)
        for depth in depths:
            if depth >= len(saved):
                continue
            # Both ways that there are to go back: to a snapshot, and to a copy.
            if depth % 2:
                again = kg.World.restore(scene, saved[-1 - depth], world.model)
            else:
                again.copy_from(copies[-1 - depth])
            for tick in range(world.tick - depth, world.tick):
                again.step(script[tick])
                assert again.state_hash == hashes[tick + 1], (
                    f"tick {world.tick}, back by {depth}: state {tick + 1}"
                )
                compared += 1
            assert again.snapshot() == saved[-1], f"tick {world.tick}, back by {depth}"
    return compared


@pytest.mark.parametrize("name", NAMES)
def test_every_tick_is_rolled_back_by_1_to_24_ticks(name: str) -> None:
    compared = rolled_back_everywhere(small(name), None, range(1, DEEPEST + 1))
    # From the 24th tick on each is rolled back by 1 + 2 + ... + 24 ticks in all.
    assert compared > (TICKS - DEEPEST) * DEEPEST * (DEEPEST + 1) // 2


@pytest.mark.parametrize("model", pairings(), ids=named)
def test_whatever_the_model_is(model: kg.Model) -> None:
    assert rolled_back_everywhere(small("everything"), model, range(5, DEEPEST + 1, 19))
