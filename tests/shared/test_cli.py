"""The command line: data on stdout, one clear line on stderr, exit codes that scripts can use."""

import json
import subprocess
import sys

import pytest

import kuglice as kg
from kuglice.replay import Recorder
from kuglice.version import VERSION


def kuglice(*arguments: str) -> subprocess.CompletedProcess[str]:
    code = "from kuglice.cli import main; main()"
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)


@pytest.fixture
def recording(tmp_path):
    path = tmp_path / "run.kuglice"
    world = kg.World(kg.scenes.cradle())
    with Recorder(path, world) as recorder:
        for tick in range(20):
            world.step([kg.Kick(ball=int(world.id[0]), vx=1, vy=0)] if tick == 12 else [])
            recorder.add([])
    return path


def test_help_lists_the_commands_and_each_has_its_own():
    shown = kuglice("--help")
    assert shown.returncode == 0
    for command in ("scenes", "plan", "replay"):
        assert command in shown.stdout
        assert kuglice(command, "--help").returncode == 0
    assert kuglice("-h").stdout == shown.stdout


def test_version():
    assert kuglice("--version").stdout == f"kuglice {VERSION}\n"


def test_an_unknown_command_is_a_usage_error():
    shown = kuglice("sceens")
    assert shown.returncode == 2
    assert "sceens" in shown.stderr
    assert not shown.stdout


def test_scenes_lists_all_and_json_has_the_same_figures():
    table, twin = kuglice("scenes"), kuglice("scenes", "--json")
    rows = json.loads(twin.stdout)
    assert [row["scene"] for row in rows] == list(kg.scenes.TABLE)
    for row in rows:
        assert f"{row['balls']:,}" in table.stdout
        assert row["shows"] in table.stdout
        assert row["parameters"] in table.stdout
    assert table.stderr == twin.stderr == ""


def test_scenes_writes_files_that_load_and_replaces_none_unasked(tmp_path):
    shown = kuglice("scenes", "gas:n=20", "cradle", "--write", str(tmp_path / "new"))
    assert shown.returncode == 0
    assert shown.stdout.splitlines() == [str(tmp_path / "new" / name) for name in ("gas.toml", "cradle.toml")]
    assert kg.Scene.load(tmp_path / "new" / "gas.toml") == kg.scenes.gas(n=20)
    (tmp_path / "new" / "gas.toml").unlink()
    again = kuglice("scenes", "gas:n=30", "cradle", "--write", str(tmp_path / "new"))
    assert again.returncode == 2
    assert "cradle.toml: exists already; --force replaces it" in again.stderr
    assert not (tmp_path / "new" / "gas.toml").exists()
    assert kuglice("scenes", "cradle", "--write", str(tmp_path / "new"), "--force").returncode == 0


def test_plan_gives_reasons_and_its_twin_the_same():
    shown, twin = kuglice("plan", "rain"), kuglice("plan", "rain", "--json")
    figures = json.loads(twin.stdout)
    assert figures["integrator"] == kg.plan(kg.scenes.rain()).integrator
    assert figures["integrator"] in shown.stdout
    assert "exact under uniform gravity" in " ".join(shown.stdout.split())


def test_an_error_is_one_line_and_exit_code_2(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text("box = [0, 0, 20, 10]\nrestitution = 7")
    shown = kuglice("plan", str(path))
    assert shown.returncode == 2
    assert shown.stdout == ""
    assert shown.stderr == f"kuglice: {path}: restitution = 7: must be less than or equal to 1\n"


def test_a_replay_that_is_equal_says_so(tmp_path):
    path = tmp_path / "run.kuglice"
    world = kg.World(kg.scenes.cradle())
    with Recorder(path, world) as recorder:
        for _ in range(20):
            world.step()
            recorder.add()
    shown, twin = kuglice("replay", str(path)), kuglice("replay", str(path), "--json")
    assert shown.returncode == 0
    assert "equal: 20 ticks, 21 hashes" in shown.stdout
    figures = json.loads(twin.stdout)
    assert figures["equal"]
    assert figures["complete"]
    assert (figures["ticks"], figures["hashes"]) == (20, 21)


def test_a_replay_that_differs_names_tick_and_balls_and_ends_with_1(recording):
    shown, twin = kuglice("replay", str(recording)), kuglice("replay", str(recording), "--json")
    assert shown.returncode == twin.returncode == 1
    assert "different from tick 13" in shown.stdout
    assert "ball 0 differs" in shown.stdout
    assert json.loads(twin.stdout)["mismatch"]["balls"] == [0]


def test_a_file_that_is_no_replay_is_refused(tmp_path):
    (tmp_path / "scene.toml").write_text("box = 1")
    shown = kuglice("replay", str(tmp_path / "scene.toml"))
    assert shown.returncode == 2
    assert "not a replay file" in shown.stderr
    assert shown.stderr.count("\n") == 1
