"""The built-in scenes: each one shows what its sentence says."""

import re

import numpy as np
import pytest

import kuglice as kg


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_every_scene_says_what_it_shows_and_runs(name):
    scene = kg.scenes.TABLE[name]()
    assert scene.title
    assert scene.description.endswith(".")
    world = kg.World(scene)
    start = world.state_hash
    world.run(30)
    assert world.tick == 30
    assert world.state_hash != start
    assert np.isfinite(world.position).all()


def test_gas_has_the_packing_it_is_asked_for():
    scene = kg.scenes.gas(n=500, packing=0.4, radius=0.7, speed=3, seed=2)
    left, bottom, right, top = scene.box
    packing = (np.pi * scene.balls.radius**2).sum() / ((right - left) * (top - bottom))
    assert packing == pytest.approx(0.4)
    assert np.hypot(*scene.balls.velocity.T) == pytest.approx(3.0)


def test_gas_keeps_its_energy_and_forgets_its_speeds():
    world = kg.World(kg.scenes.gas(n=400, packing=0.2))
    energy = world.energy
    world.run(600)
    assert world.energy == pytest.approx(energy, rel=1e-12)
    speed = np.hypot(*world.velocity.T)
    # Maxwell in two dimensions: <v>/sqrt(<v^2>) = sqrt(pi)/2 = 0.886; equal speeds have 1.
    assert speed.mean() / np.sqrt((speed**2).mean()) == pytest.approx(0.886, abs=0.03)


def test_rain_falls_and_keeps_its_energy():
    world = kg.World(kg.scenes.rain(n=300))
    height, energy = world.position[:, 1].mean(), world.energy
    world.run(150)
    assert world.position[:, 1].mean() < height - 5
    # Overlaps are noticed up to a substep late, which moves a bounce by that much of a fall.
    assert world.energy == pytest.approx(energy, rel=0.01)


def test_break_opens_a_rack_of_5050():
    scene = kg.scenes.break_()
    assert len(scene.balls) == 5051
    world = kg.World(scene)
    world.run(600)
    moved = np.hypot(*(world.position - scene.balls.position).T) > 0.01
    assert moved.sum() > 1000
    assert world.energy == pytest.approx(kg.World(scene).energy, rel=1e-9)


def test_one_ball_into_the_cradle_and_one_ball_out():
    world = kg.World(kg.scenes.cradle(n=5, speed=8))
    world.run(480)
    assert world.collisions == 5
    speeds = np.sort(np.abs(world.velocity[:, 0]))
    assert speeds[-1] == pytest.approx(8.0)
    assert speeds[:-1] == pytest.approx(np.zeros(5), abs=1e-12)


def test_orbits_stay_circles_and_never_meet():
    world = kg.World(kg.scenes.orbit())
    distance = np.hypot(*world.position.T)
    world.run(60 * 60)
    assert world.collisions == 0
    assert world.wall_hits == 0
    assert np.hypot(*world.position.T) == pytest.approx(distance, rel=0.02)


def test_pegs_stay_and_balls_reach_the_bins_in_a_bell():
    scene = kg.scenes.pegs(n=200)
    world = kg.World(scene)
    world.run(int(12 * scene.tick_rate))
    pegs = np.isinf(scene.balls.mass)
    assert (world.position[pegs] == scene.balls.position[pegs]).all()
    x, y = world.position[~pegs].T
    assert (y < 9).mean() > 0.9
    middle = scene.box[2] / 2
    near, far = np.abs(x - middle) < 6, np.abs(x - middle) > 14
    assert near.sum() > 3 * far.sum()


def test_mixed_holds_radii_from_a_tenth_to_two():
    radius = kg.scenes.mixed().balls.radius
    assert 0.1 <= radius.min() < 0.15
    assert 1.9 < radius.max() <= 2.0


def test_dam_lets_ten_thousand_balls_run_to_the_other_end():
    scene = kg.scenes.dam(n=2000)
    assert len(kg.scenes.dam().balls) == 10_000
    world = kg.World(scene)
    assert world.position[:, 0].max() < 10
    world.run(int(3 * scene.tick_rate))
    assert world.position[:, 0].max() > 25


def test_a_player_of_the_arena_steers_a_ball_by_thrust():
    scene = kg.scenes.arena(players=2, balls=500)
    world = kg.World(scene)
    join = kg.inputs.join(scene, world, client=1)
    world.step([join])
    ((client, ball),) = world.players
    assert client == 1
    inwards = 1 if join.x < 32 else -1
    thrust = kg.Thrust(client=1, x=inwards * scene.limits.thrust, y=0)
    kg.inputs.check(thrust, scene, world)
    index = int(np.searchsorted(world.id, ball))
    start = world.position[index]
    world.step([thrust])
    world.run(30)
    assert inwards * (world.position[index, 0] - start[0]) > 2
    assert len(scene.balls) == 500


def test_spawn_points_of_the_arena_are_free():
    for players in (1, 2, 3, 8, 12):
        scene = kg.scenes.arena(players=players)
        world = kg.World(scene)
        world.step([kg.inputs.join(scene, world, client=1)])
        for client in range(2, players + 1):
            world.step([kg.inputs.join(scene, world, client=client)])
        owned = [ball for _, ball in world.players]
        assert len(set(owned)) == players


def test_scenes_are_found_by_name_parameters_and_file(tmp_path):
    assert kg.scenes.find("gas") == kg.scenes.gas()
    assert kg.scenes.find("gas:n=20,packing=0.5") == kg.scenes.gas(n=20, packing=0.5)
    assert kg.scenes.find("break: rows = 3 ") == kg.scenes.break_(rows=3)
    kg.scenes.cradle().save(tmp_path / "mine.toml")
    assert kg.scenes.find(str(tmp_path / "mine.toml")) == kg.scenes.cradle()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("gsa", "did you mean gas"),
        ("", "neither a file nor one of gas, rain"),
        ("gas:m=3", "scene gas: 'm' is none of its parameters, which are n=1000, packing=0.3"),
        ("gas:pakcing=0.2", "did you mean packing?"),
        ("gas:n", "scene gas: 'n' has no value: must be parameter=value, like n=1000"),
        ("gas:n=5,n=6", "scene gas: n = 6: is given twice, first as 5"),
        ("gas:packing=0.99", "scene gas: packing = 0.99: must be greater than 0 and at most 0.9069"),
        (
            "gas:packing=0.9",
            "scene 'gas:packing=0.9': these parameters make no scene: Scene: groups[0].count = 1000",
        ),
        ("arena:players=31", "scene arena: players = 31: must be a whole number, at most 30"),
        ("arena:balls=5000", "scene 'arena:balls=5000': these parameters make no scene"),
        ("gas:n=many", "n = 'many': must be a whole number"),
        ("gas:n=0", "scene gas: n = 0: must be a whole number, at least 1"),
        ("gas:n=-5", "scene gas: n = -5: must be a whole number, at least 1"),
        ("gas:packing=0", "scene gas: packing = 0.0: must be greater than 0"),
        ("gas:packing=nan", "scene gas: packing = nan: must be greater than 0"),
        ("gas:radius=inf", "scene gas: radius = inf: must be finite and greater than 0"),
        ("gas:speed=-1", "scene gas: speed = -1.0: must be finite and at least 0"),
        ("gas:seed=-1", "scene gas: seed = -1: must be a whole number, at least 0"),
        ("pegs:n=1" + "0" * 400, "must be a whole number, at most 10,000,000"),
        ("gas:n=99999999999", "scene gas: n = 99999999999: must be a whole number, at most 10,000,000"),
        ("rain:radius=-1", "scene rain: radius = -1.0: must be finite and greater than 0"),
        ("rain:gravity=nan", "scene rain: gravity = nan: must be finite"),
        ("dam:n=0", "scene dam: n = 0"),
        ("mixed:packing=-1", "scene mixed: packing = -1.0"),
        ("cradle:n=0", "scene cradle: n = 0"),
        ("cradle:speed=nan", "scene cradle: speed = nan"),
        ("cradle:gap=-0.5", "scene cradle: gap = -0.5: must be finite and at least 0"),
        ("break:rows=-1", "scene break: rows = -1"),
        ("orbit:n=0", "scene orbit: n = 0"),
        ("orbit:strength=-3", "scene orbit: strength = -3.0: must be finite and at least 0"),
        ("orbit:softening=0", "scene orbit: softening = 0.0"),
        ("arena:players=0", "scene arena: players = 0"),
        ("arena:balls=-4", "scene arena: balls = -4"),
        ("pegs:rows=-3", "scene pegs: rows = -3"),
        ("missing.toml", "cannot be read"),
        ("/", "scene '/': is a directory, must be a TOML file or one of gas, rain"),
    ],
)
def test_a_scene_that_is_not_found_is_explained(text, told):
    with pytest.raises(kg.errors.SceneError, match=re.escape(told)):
        kg.scenes.find(text)
