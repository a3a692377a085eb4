"""World: what every program is written against."""

import subprocess
import sys
import threading

import numpy as np
import pytest

import kuglice as kg


@pytest.fixture
def world() -> kg.World:
    return kg.World(kg.scenes.gas(n=50))


def test_the_model_is_planned_unless_given():
    scene = kg.scenes.gas(n=50)
    assert kg.World(scene).model == kg.plan(scene)
    model = kg.Model(integrator="rk4", broadphase="brute")
    assert kg.World(scene, model).model is model


def test_a_world_starts_from_its_scene(world):
    balls = world.scene.balls
    assert world.tick == 0
    assert world.time == 0.0
    assert len(world) == world.count == 50
    assert (world.position == balls.position).all()
    assert (world.velocity == balls.velocity).all()
    assert (np.diff(world.id.astype(np.int64)) == 1).all()
    assert world.energy == pytest.approx((balls.mass * (balls.velocity**2).sum(axis=1)).sum() / 2)
    assert world.momentum == pytest.approx(tuple((balls.mass[:, None] * balls.velocity).sum(axis=0)))


def test_time_goes_by_tick_rate_or_by_the_step_given(world):
    world.run(30)
    assert world.time == pytest.approx(0.5)
    world.step(dt=0.25)
    assert world.tick == 31
    assert world.time == pytest.approx(0.75)


def test_arrays_are_copies_safe_to_keep(world):
    before, kept = world.position, world.position
    world.run(10)
    assert (before == kept).all()
    before[:] = 0
    assert (world.position != 0).all()


def test_a_view_is_the_memory_itself_and_read_only(world):
    with world.view() as balls:
        assert (balls.position == world.position).all()
        assert (balls.id == world.id).all()
        with pytest.raises(ValueError, match="read-only"):
            balls.position[0] = 0


@pytest.mark.parametrize(
    "change",
    [
        lambda world: world.step(),
        lambda world: world.run(1),
        lambda world: world.copy_from(world.clone()),
    ],
)
def test_what_is_lent_cannot_be_changed(world, change):
    start = world.state_hash
    with world.view(), pytest.raises(kg.errors.LentError):
        change(world)
    assert world.state_hash == start
    change(world)


def test_a_view_ends_when_its_block_raises(world):
    with pytest.raises(ZeroDivisionError), world.view():
        raise ZeroDivisionError
    world.step()


def test_clones_and_snapshots_go_on_alike(world):
    world.run(20)
    clone, again = world.clone(), kg.World.restore(world.scene, world.snapshot(), model=world.model)
    other = kg.World(world.scene)
    other.copy_from(world)
    for each in (world, clone, again, other):
        each.run(50)
    assert world.state_hash == clone.state_hash == again.state_hash == other.state_hash
    assert clone.model == world.model


def test_a_clone_is_independent(world):
    clone = world.clone()
    clone.run(5)
    assert world.tick == 0


def test_inputs_come_as_objects_or_as_records(world):
    kick = kg.Kick(ball=int(world.id[3]), vx=1, vy=2)
    other = world.clone()
    world.step([kick])
    other.step(kg.inputs.pack([kick]))
    assert world.state_hash == other.state_hash
    assert world.inputs_applied == 1
    assert world.velocity[3] == pytest.approx(world.scene.balls.velocity[3] + (1, 2))


def test_an_input_without_effect_is_counted(world):
    world.step([kg.Remove(ball=10**6)])
    assert world.inputs_ignored == 1


def test_bytes_that_are_no_records_are_refused(world):
    with pytest.raises(kg.errors.InputError):
        world.step(b"abc")
    assert world.tick == 0


def test_energy_counts_potential_and_leaves_out_pegs():
    balls = kg.Balls(position=[(5, 5), (10, 5)], velocity=(3, 4), radius=1, mass=[2, np.inf])
    scene = kg.Scene(box=(0, 0, 20, 10), balls=balls, forces=[kg.Gravity(0, -10)])
    world = kg.World(scene)
    assert world.kinetic_energy == pytest.approx(25.0)
    assert world.momentum == pytest.approx((6.0, 8.0))
    assert np.isfinite(world.energy)


@pytest.mark.parametrize("ticks", [-1, 1.5, "3", 2**70, None])
def test_a_number_of_ticks_that_cannot_be_run_is_refused(world, ticks):
    with pytest.raises(kg.errors.LimitError, match=r"run: ticks = .*: must be a whole number, at least 0"):
        world.run(ticks)
    assert world.tick == 0
    world.run(np.int64(2))
    assert world.tick == 2


@pytest.mark.parametrize(
    ("inputs", "told"),
    [([1], "input 1: must be one of Join"), ("no", "input 'n'"), (3, "inputs = 3: must be a sequence")],
)
def test_what_is_no_input_is_refused_and_nothing_is_lost(world, inputs, told):
    start = world.state_hash
    with pytest.raises(kg.errors.InputError, match=told):
        world.step(inputs)
    assert world.state_hash == start


def test_a_snapshot_from_elsewhere_is_refused(world):
    far = kg.Scene(box=(1000, 1000, 1100, 1100), balls=kg.Balls(position=[(1050, 1050)], radius=1))
    with pytest.raises(kg.errors.SnapshotError, match=r"all 50 balls lie outside the box .* another scene"):
        kg.World.restore(far, world.snapshot())
    open_plane = far.model_copy(update={"walls": False})
    assert kg.World.restore(open_plane, world.snapshot()).count == 50


def test_stepping_lets_other_threads_run():
    world = kg.World(kg.scenes.gas(n=20_000))
    counted, running = 0, True

    def count():
        nonlocal counted
        while running:
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    start = counted
    world.run(200)
    during = counted - start
    running = False
    thread.join()
    # Were the lock held, the thread could count only in the moments around the call.
    assert during > 1000


def test_a_world_and_a_scene_show_themselves(world):
    pytest.importorskip("PIL")
    assert world._repr_png_().startswith(b"\x89PNG")
    assert world.scene._repr_png_().startswith(b"\x89PNG")
    assert "50 balls" in repr(world)


def test_importing_the_package_is_light():
    heavy = "zenoh", "PIL", "av", "typer", "rich", "matplotlib"
    code = f"import kuglice, sys; print([name for name in {heavy} if name in sys.modules])"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert out.strip() == "[]"


def test_modules_that_few_need_come_on_first_use():
    for name in ("loop", "picture", "protocol", "replay"):
        assert getattr(kg, name).__name__ == f"kuglice.{name}"
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = kg.nothing


def test_the_package_lists_what_is_public_and_nothing_else():
    assert dir(kg) == sorted([*kg.__all__, "__version__"])
    for name in kg.__all__:
        assert getattr(kg, name) is not None
    for name in ("loop", "picture", "replay", "protocol", "World"):
        assert name in kg.__all__


@pytest.mark.parametrize("contacts", ["overlap", "backtrack", "event"])
def test_threads_show_in_nothing(contacts):
    scene = kg.scenes.gas(n=3000)
    model = kg.Model(integrator="verlet", contacts=contacts)
    judge = kg.World(scene, model)
    judge.run(20)
    for threads in (2, 3, 8):
        world = kg.World(scene, model, threads=threads)
        world.run(10)
        again = kg.World.restore(scene, world.snapshot(), model, threads=threads + 1)
        again.run(5)
        copy = again.clone()
        copy.run(5)
        assert (world.threads, again.threads, copy.threads) == (threads, threads + 1, threads + 1)
        assert copy.state_hash == judge.state_hash
        assert copy.snapshot() == judge.snapshot()


@pytest.mark.parametrize("threads", [0, -1, 257, 1.5, "2"])
def test_threads_out_of_bounds_are_refused(threads):
    with pytest.raises(kg.errors.LimitError, match="at least 1 and at most 256"):
        kg.World(kg.scenes.gas(n=10), threads=threads)


@pytest.mark.parametrize(("count", "said"), [(1, "1 ball,"), (2, "2 balls,")])
def test_it_says_how_many_balls_it_has(count, said):
    assert said in repr(kg.World(kg.scenes.gas(n=count)))
