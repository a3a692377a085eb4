"""Replays: what was recorded runs again to the same bits, and what does not is named."""

import random

import pytest

import kuglice as kg
from kuglice.replay import Recorder, Replay, difference
from kuglice.replay.format import MAGIC, State, Tick, read_replay
from kuglice.replay.framing import FRAME, write_record

SCENE = kg.scenes.arena(players=2, balls=60)


def script(tick: int, world: kg.World) -> list[kg.Input]:
    """Joins, thrusts, a spawn, kicks, a removal and a leave: every kind of input."""
    if tick in (1, 2):
        return [kg.inputs.join(SCENE, world, client=tick)]
    special = {
        5: [kg.Spawn(client=2, x=30, y=30, radius=0.2, mass=1)],
        8: [kg.Attract(client=2, x=30, y=20, strength=100)],
        20: [kg.Kick(client=2, vx=5, vy=5), kg.Remove(client=2, sequence=1, ball=4)],
        40: [kg.Leave(client=2)],
    }
    thrust = kg.Thrust(client=1, sequence=tick, x=100 - tick, y=tick)
    return [*special.get(tick, []), thrust] if tick > 2 else []


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.kuglice"


def record(path, ticks=60, world=None, disturb=None, **options) -> kg.World:
    world = world or kg.World(SCENE)
    with Recorder(path, world, **options) as recorder:
        for _ in range(ticks):
            inputs = script(world.tick, world) if world.tick in range(100) else []
            secret = [] if world.tick != disturb else [kg.Kick(sequence=9, ball=7, vx=1e-9, vy=0)]
            world.step([*inputs, *secret])
            recorder.add(inputs)
    return world


def test_a_recording_runs_again_to_the_same_bits(path):
    world = record(path)
    replay = Replay.load(path)
    assert replay.complete
    assert len(replay) == 60
    assert replay.scene.balls == SCENE.balls
    assert replay.model == world.model
    result = replay.verify()
    assert result.ok
    assert (result.ticks, result.hashes) == (60, 61)
    assert str(result) == "equal: 60 ticks, 61 hashes"
    *_, last = replay.worlds()
    assert last.state_hash == world.state_hash


def test_inputs_are_kept(path):
    record(path)
    replay = Replay.load(path)
    assert [given.kind for given in replay.inputs(20)] == ["kick", "remove", "thrust"]
    assert replay.inputs(0) == []


def test_a_recording_may_start_in_the_middle(path):
    world = kg.World(SCENE)
    world.run(200)
    record(path, world=world, ticks=30)
    replay = Replay.load(path)
    assert replay.start == 200
    assert replay.verify().ok


def test_a_variable_step_is_recorded(path):
    world = kg.World(SCENE)
    with Recorder(path, world) as recorder:
        for dt in (0.01, 0.02, 0.005):
            world.step(dt=dt)
            recorder.add(dt=dt)
    assert Replay.load(path).verify().ok


@pytest.mark.parametrize("hash_every", [1, 7])
def test_a_mismatch_names_the_first_tick_and_the_balls(path, hash_every):
    record(path, disturb=25, hash_every=hash_every, state_every=30)
    result = Replay.load(path).verify()
    assert not result.ok
    assert result.mismatch.tick == (26 if hash_every == 1 else 28)
    assert 7 in result.mismatch.balls
    assert result.mismatch.difference.tick == 30
    assert f"tick {result.mismatch.tick}: hash" in str(result)
    assert "ball" in str(result)


def test_the_final_state_names_the_balls_if_no_other_does(path):
    record(path, ticks=40, disturb=35)
    result = Replay.load(path).verify()
    assert result.mismatch.tick == 36
    assert result.mismatch.difference.tick == 40
    assert 7 in result.mismatch.balls


def test_unless_told_states_are_close_enough_to_name_the_balls_before_chaos_spreads(path):
    record(path, ticks=90, disturb=25)
    result = Replay.load(path).verify()
    assert result.mismatch.tick == 26
    assert result.mismatch.difference.tick == 30
    assert result.mismatch.balls == (7,)
    assert "known from the first recorded state after it: at tick 30 ball 7 differs" in str(result)


def test_states_stay_below_a_bound_of_bytes_per_second(path):
    world = kg.World(kg.scenes.gas(n=3000))
    with Recorder(path, world) as recorder:
        for _ in range(120):
            world.step()
            recorder.add()
    states = [each for each in read_replay(path) if isinstance(each, State)]
    assert [each.tick for each in states] == [110, 120]  # the last one because the recording ends there
    assert len(states[0].data) <= 110 / 60 * 64 * 1024


def test_a_wrong_hash_is_told_from_a_world_that_differs(path):
    record(path, ticks=20)
    records = list(read_replay(path))
    with path.open("wb") as file:
        file.write(MAGIC)
        for each in records:
            wrong = isinstance(each, Tick) and each.tick == 4
            write_record(file, each.model_copy(update={"hash": each.hash ^ 1}) if wrong else each)
    result = Replay.load(path).verify()
    assert result.mismatch.tick == 5
    assert result.mismatch.only_hash
    assert result.mismatch.balls == ()
    assert "the hash in the file is wrong, no ball differs" in str(result)


def test_a_recording_that_was_cut_off_loses_its_last_record_only(path):
    world = kg.World(SCENE)
    recorder = Recorder(path, world)
    for _ in range(25):
        world.step()
        recorder.add()
    # Neither closed nor collected: what a crash leaves behind is what is in the file now.
    data = path.read_bytes()
    path.write_bytes(data[:-3])
    replay = Replay.load(path)
    assert not replay.complete
    assert len(replay) == 24
    result = replay.verify()
    assert result.ok
    assert "cut off" in str(result)
    recorder.close()


def test_a_recording_can_be_cut_anywhere(path):
    record(path, ticks=30, state_every=10)
    data = path.read_bytes()
    generator = random.Random(4)
    for length in [0, 5, len(MAGIC), *generator.sample(range(len(data)), 60)]:
        path.write_bytes(data[:length])
        try:
            replay = Replay.load(path)
        except kg.errors.ReplayError:
            assert length < len(MAGIC) + FRAME.size + 60_000
        else:
            assert not replay.complete
            assert len(replay) < 31


def test_any_damage_is_found(path):
    record(path, ticks=30, state_every=10)
    data = bytearray(path.read_bytes())
    generator = random.Random(5)
    for at in generator.sample(range(len(data)), 80):
        damaged = bytearray(data)
        damaged[at] ^= 1 << generator.randrange(8)
        path.write_bytes(damaged)
        try:
            replay = Replay.load(path)
        except kg.errors.ReplayError:
            continue
        # The length of a record was made larger than the rest of the file: the same as a cut.
        assert not replay.complete


@pytest.mark.parametrize("content", [b"", b"nothing", MAGIC, MAGIC + b"\xff" * 100, MAGIC + bytes(8)])
def test_what_is_no_replay_is_refused(path, content):
    path.write_bytes(content)
    with pytest.raises(kg.errors.ReplayError, match=r"run\.kuglice"):
        Replay.load(path)


def test_a_file_that_is_not_there_is_refused(path):
    with pytest.raises(kg.errors.ReplayError, match="cannot be read"):
        Replay.load(path)
    with pytest.raises(kg.errors.ReplayError, match="cannot be written"):
        Recorder(path / "deeper", kg.World(SCENE))


def test_a_tick_that_was_left_out_is_refused(path):
    world = kg.World(SCENE)
    with Recorder(path, world) as recorder:
        world.run(2)
        with pytest.raises(kg.errors.ReplayError, match="at tick 2, expected 1"):
            recorder.add()


def test_another_step_version_is_refused_before_it_differs(path):
    record(path, ticks=5)
    replay = Replay.load(path)
    replay.step_version += 1
    with pytest.raises(kg.errors.ReplayError, match="other bits would come out"):
        replay.verify()


def test_difference_names_balls_that_only_one_world_has():
    first, second = kg.World(SCENE), kg.World(SCENE)
    first.step([kg.Remove(ball=int(first.id[3]))])
    second.step()
    found = difference(first, second)
    assert found.balls[0] == 3 or 3 in found.balls
    assert not difference(first, first.clone()).balls
    assert "no ball differs" in str(difference(first, first.clone()))
