"""A run as a film, and the command that makes one."""

from __future__ import annotations

import json

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

import kuglice as kg
from client.render.stages import SIZE, read, scene
from kuglice.errors import KugliceError, PictureError
from kuglice.picture import Camera
from kuglice_client.cli import render
from kuglice_client.render import film


def run(world, ticks):
    yield world
    for _ in range(ticks):
        world.step()
        yield world


def place(path):
    """x of the right ball in a picture, in units of the scene."""
    pixels = read(path).astype(int)
    camera = Camera.fit(scene().box, SIZE)
    row = pixels[int(camera.points(np.array([[0.0, 5.0]]))[0, 1])].sum(axis=1)
    middle = SIZE[0] // 2
    bright = np.nonzero(row[middle : middle + 130] > 200)[0] + middle
    return (bright.mean() + 0.5 - SIZE[0] / 2) / camera.scale + 10


@pytest.mark.parametrize(
    ("fps", "speed", "frames"),
    [(30, 1.0, 31), (60, 1.0, 61), (24, 1.0, 25), (120, 1.0, 121), (30, 2.0, 16), (30, 0.25, 121)],
)
def test_frames_lie_at_equal_times_of_the_scene(tmp_path, fps, speed, frames):
    world = kg.World(scene())
    count = film(run(world, 60), tmp_path / "%d.png", fps=fps, speed=speed, size=SIZE, overlays=())
    assert count == frames
    # The right ball starts at x = 15 and moves by 1 per second.
    for number in range(0, frames, 7):
        assert place(tmp_path / f"{number}.png") == pytest.approx(15 + number * speed / fps, abs=0.04)


def test_a_film_that_starts_in_the_middle_starts_with_that_state(tmp_path):
    world = kg.World(scene())
    world.run(60)
    film(run(world, 2), tmp_path / "%d.png", fps=30, size=SIZE, overlays=())
    assert place(tmp_path / "0.png") == pytest.approx(16, abs=0.04)


def test_looking_does_not_change_the_run(tmp_path):
    world, alone = kg.World(kg.scenes.find("gas:n=60")), kg.World(kg.scenes.find("gas:n=60"))
    film(
        run(world, 30), tmp_path / "end.png", size=SIZE, overlays=("tick", "tree"), trails=0.5, style="fluid"
    )
    alone.run(30)
    assert world.state_hash == alone.state_hash


def test_no_states_are_no_film(tmp_path):
    assert film([], tmp_path / "film.mp4") == 0
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("speed", [0.0, -1.0, float("nan")])
def test_a_film_cannot_stand_still(tmp_path, speed):
    with pytest.raises(PictureError, match="speed"):
        film(run(kg.World(scene()), 1), tmp_path / "film.mp4", speed=speed)


@pytest.fixture
def command():
    app = typer.Typer()
    app.callback()(lambda: None)
    render.register(app)
    return lambda *arguments: CliRunner().invoke(app, ["render", *map(str, arguments)])


def test_the_command_draws_a_scene_and_prints_its_figures(tmp_path, command):
    path = tmp_path / "gas.png"
    done = command("gas:n=100", "--out", path, "--seconds", 0.5, "--fps", 20, "--size", "200x120", "--json")
    assert done.exit_code == 0, done.output
    figures = json.loads(done.stdout)
    world = kg.World(kg.scenes.find("gas:n=100"))
    world.run(30)
    assert figures["frames"] == 11
    assert figures["ticks"] == 30
    assert figures["state_hash"] == f"{world.state_hash:016x}"
    assert read(path).shape == (120, 200, 3)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (("--style", "jelly"), "jelly"),
        (("--overlay", "forest"), "forest"),
        (("--size", "big"), "big"),
        (("--seconds", "-1"), "-1"),
    ],
)
def test_the_command_refuses_by_name(tmp_path, command, wrong, message):
    done = command("gas:n=50", "--out", tmp_path / "x.mp4", *wrong)
    assert isinstance(done.exception, KugliceError)
    assert message in str(done.exception)
    assert not list(tmp_path.iterdir())
