"""Record, replay, compare: here, in another process, and with one bit changed on the way."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import kuglice as kg
from determinism.flying import flight
from determinism.models import named, pairings
from determinism.small_scenes import NAMES, small
from kuglice.inputs import Input
from kuglice.replay import Recorder, Replay

TICKS = 120


def record(path: Path, world: kg.World, script: list[list[Input]], **options: int) -> None:
    with Recorder(path, world, **options) as recorder:
        for inputs in script:
            world.step(inputs)
            recorder.add(inputs)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("model", pairings(), ids=named)
def test_a_recording_replays_to_the_same_bits(tmp_path: Path, name: str, model: kg.Model) -> None:
    scene = small(name)
    record(tmp_path / "run", kg.World(scene, model), flight(scene, TICKS))
    verification = Replay.load(tmp_path / "run").verify()
    assert verification.ok, verification
    assert verification.complete
    assert verification.ticks == TICKS
    assert verification.hashes == TICKS + 1


def test_a_recording_may_begin_in_the_middle_of_a_run(tmp_path: Path) -> None:
    scene = small("everything")
    script = flight(scene, TICKS)
    world = kg.World(scene)
    for inputs in script[:50]:
        world.step(inputs)
    record(tmp_path / "run", world, script[50:], hash_every=7)
    verification = Replay.load(tmp_path / "run").verify()
    assert verification.ok, verification
    assert verification.ticks == TICKS - 50


def test_the_command_line_replays_it_in_another_process(tmp_path: Path) -> None:
    scene = small("everything")
    record(tmp_path / "run", kg.World(scene), flight(scene, TICKS))
    command = [sys.executable, "-m", "kuglice", "replay", str(tmp_path / "run"), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["hashes"] == TICKS + 1


def test_an_input_that_was_not_recorded_is_found_at_its_tick(tmp_path: Path) -> None:
    scene = small("everything")
    world = kg.World(scene)
    with Recorder(tmp_path / "run", world, state_every=20) as recorder:
        for tick in range(TICKS):
            # Into an untouched corner of the scene, so that one ball alone differs for some ticks.
            hidden = [kg.Kick(ball=5, vx=1e-9, vy=0.0)] if tick == 80 else []
            world.step(hidden)
            recorder.add([])
    mismatch = Replay.load(tmp_path / "run").verify().mismatch
    assert mismatch is not None
    assert mismatch.tick == 81
    assert 5 in mismatch.balls
