"""Same scene, same inputs, same bits: again, in another process, in another order of arrival."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import kuglice as kg
from determinism.flying import flight, trail
from determinism.small_scenes import BUILT_IN, NAMES, small

TICKS = 240
FLY_IT_AGAIN = """
import json, sys
sys.path.insert(0, sys.argv[1])
import kuglice as kg
from determinism.flying import flight, trail
from determinism.small_scenes import NAMES, small
trails = {name: trail(kg.World(small(name)), flight(small(name), int(sys.argv[2]))) for name in NAMES}
print(json.dumps(trails))
"""


def test_every_built_in_scene_is_among_the_small_ones() -> None:
    assert set(BUILT_IN) == set(kg.scenes.TABLE)


@pytest.mark.parametrize("name", NAMES)
def test_twice_in_one_process(name: str) -> None:
    first, second = kg.World(small(name)), kg.World(small(name))
    assert trail(first, flight(small(name), TICKS)) == trail(second, flight(small(name), TICKS))
    assert first.snapshot() == second.snapshot()


def test_in_two_processes() -> None:
    command = [sys.executable, "-c", FLY_IT_AGAIN, str(Path(__file__).parents[1]), str(TICKS)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    there = json.loads(done.stdout)
    here = {name: trail(kg.World(small(name)), flight(small(name), TICKS)) for name in NAMES}
    assert there == here


@pytest.mark.parametrize("name", NAMES)
def test_the_order_in_which_inputs_arrive_means_nothing(name: str) -> None:
    script = flight(small(name), TICKS)
    turned = [list(reversed(inputs)) for inputs in script]
    assert any(inputs != other for inputs, other in zip(script, turned, strict=True))
    assert trail(kg.World(small(name)), script) == trail(kg.World(small(name)), turned)


def test_the_inputs_do_fly() -> None:
    """The other tests would be hollow if worlds ignored all that the pilots send."""
    scene = small("everything")
    flown, left_alone = kg.World(scene), kg.World(scene)
    trail(flown, flight(scene, TICKS))
    left_alone.run(TICKS)
    assert flown.state_hash != left_alone.state_hash
    assert flown.inputs_applied > TICKS
    assert flown.inputs_ignored > 0
    assert flown.next_id > left_alone.next_id
    assert flown.collisions > 0


@pytest.mark.parametrize("column", [0, 1])
def test_one_bit_of_one_ball_is_another_hash(column: int) -> None:
    scene = small("everything")
    position = scene.balls.position.copy()
    position[0, column] = np.nextafter(position[0, column], np.inf)
    balls = kg.Balls(
        position=position, velocity=scene.balls.velocity, radius=scene.balls.radius, mass=scene.balls.mass
    )
    nudged = scene.model_copy(update={"balls": balls})
    assert kg.World(nudged).state_hash != kg.World(scene).state_hash
