"""The command line: data on stdout, one clear line on stderr, exit codes that scripts can use."""

import json
import os
import subprocess
import sys

import pytest

import kuglice as kg
from kuglice.cli.figures import print_figures
from kuglice.replay import Recorder
from kuglice.version import VERSION


def kuglice(*arguments: str, before: str = "") -> subprocess.CompletedProcess[str]:
    """`before`: a statement that runs first."""
    code = f"{before}\nfrom kuglice.cli import main; main()"
    command = [sys.executable, "-c", code, *arguments]
    # Where help is wrapped depends on it.
    there = {**os.environ, "COLUMNS": "100"}
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env=there)


WITHOUT_EXTRAS = "import sys; sys.modules['PIL'] = sys.modules['av'] = None"
"""As if they were not installed."""


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


def test_help_lists_first_what_comes_first_and_cuts_no_sentence():
    _, listed = kuglice("--help").stdout.split("Commands:\n")
    named = [line.split()[0] for line in listed.splitlines()]
    assert named[:8] == ["demo", "scenes", "plan", "render", "server", "client", "view", "router"]
    assert named[8:13] == ["replay", "study", "chart", "bench", "proxy"]
    for line in listed.splitlines():
        assert line.endswith("."), line
        assert not line.endswith(".."), line
        assert len(line.split(maxsplit=1)[1]) <= 60


def test_scenes_and_files_are_called_the_same_everywhere():
    for command in ("plan", "render", "server", "chart", "scenes"):
        assert "SCENE" in kuglice(command, "--help").stdout.splitlines()[0]
    assert "FILE" in kuglice("replay", "--help").stdout.splitlines()[0]


def test_an_interrupt_while_starting_ends_quietly_with_130():
    interrupt = "import kuglice.cli.app\ndef stop(): raise KeyboardInterrupt\nkuglice.cli.app.build = stop"
    shown = kuglice("scenes", before=interrupt)
    assert (shown.returncode, shown.stdout, shown.stderr) == (130, "", "")


@pytest.mark.parametrize("command", ["server arena", "client"])
def test_a_time_below_zero_is_refused(command):
    shown = kuglice(*command.split(), "--seconds", "-1")
    assert shown.returncode == 2
    assert "--seconds" in shown.stderr


@pytest.mark.parametrize(
    ("command", "option", "value"),
    [(["client"], "--wait", "-1"), (["client"], "--fps", "x7"), (["server", "arena"], "--threads", "-3")],
    ids=["below", "no number", "of a server"],
)
def test_a_value_that_cannot_be_is_named_with_its_option(command, option, value):
    refused = kuglice(*command, option, value)
    assert refused.returncode == 2
    assert f"Invalid value for '{option}': " in refused.stderr
    assert value in refused.stderr.rpartition(option)[2]


def test_a_bot_that_a_demo_cannot_have_is_refused_in_one_line(tmp_path):
    refused = kuglice("demo", "--bot", "foo", "--no-film", "--out", str(tmp_path))
    assert refused.returncode == 2
    assert refused.stderr == (
        "kuglice: bot 'foo': there is none of that name, only chaser, drifter, herder, orbiter\n"
    )


def test_what_a_client_cannot_draw_is_refused_before_it_connects():
    # Nobody listens there: whoever gets as far as to connect says so.
    nobody = ("client", "--connect", "tcp/127.0.0.1:9", "--wait", "0")
    for wrong, told in [
        (("--render", "x.foo"), "output x.foo: must be a directory, or its suffix one of .mp4, .webm"),
        (
            ("--render", "x.mp4", "--size", "31x20"),
            "output x.mp4: a film needs even numbers of pixels, got 31x20",
        ),
        (("--size", "wide"), "size 'wide': must be two whole numbers of pixels like 1280x720"),
        (("--world", "a/b"), "world 'a/b': must be 1 to 32 letters"),
        (("--name", ""), "client '': must be 1 to 32 letters"),
        (("--connect", "7447"), "endpoint '7447': must look like tcp+udp/127.0.0.1:7447"),
        (("--style", "nope"), "style 'nope': there is none of that name, only discs"),
        (("--overlay", "nope", "--render", "x.gif"), "overlay 'nope': there is none of that name"),
    ]:
        shown = kuglice(*nobody, *wrong)
        assert shown.returncode == 2
        assert shown.stderr.startswith(f"kuglice: {told}")
        assert shown.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "command",
    [
        "server arena --insecure --listen tcp/nobody.invalid:7447",
        "server arena --connect tcp/nobody.invalid:7447",
        "server arena --listen tcp/127.0.0.1:0 --connect tcp/nobody.invalid:7447",
        "router --connect tcp/nobody.invalid:7447",
        "proxy 127.0.0.1:1 tcp/nobody.invalid:7447",
        "proxy tcp/nobody.invalid:7447",
    ],
)
def test_a_host_without_an_address_is_named_before_anything_is_opened(command):
    # A name that may never be given to anybody (RFC 6761); whoever waits for it does so for longer than this test.
    shown = kuglice(*command.split())
    told = "kuglice: endpoint 'tcp/nobody.invalid:7447': no address is known of a host nobody.invalid\n"
    assert (shown.returncode, shown.stdout, shown.stderr) == (2, "", told)


@pytest.mark.parametrize("command", ["demo --out {}", "client --render {}/x.mp4", "replay {} --render x.mp4"])
def test_a_missing_extra_is_named_before_anything_else_is_done(command, recording, tmp_path):
    target = recording if command.startswith("replay") else tmp_path / "out"
    shown = kuglice(*command.format(target).split(), before=WITHOUT_EXTRAS)
    assert shown.returncode == 2
    assert shown.stderr == "kuglice: Pillow is not installed; it comes with: pip install 'kuglice[render]'\n"
    assert shown.stdout == ""
    assert not (tmp_path / "out").exists()


def test_a_notebook_without_pillow_shows_text():
    code = (
        "import kuglice as kg; w = kg.World(kg.scenes.cradle()); print(w._repr_png_(), w.scene._repr_png_())"
    )
    command = [sys.executable, "-c", f"{WITHOUT_EXTRAS}\n{code}"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "None None\n"


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


def test_a_replay_that_was_cut_off_says_so_and_ends_with_3(tmp_path):
    path = tmp_path / "run.kuglice"
    world = kg.World(kg.scenes.cradle())
    with Recorder(path, world) as recorder:
        for _ in range(20):
            world.step()
            recorder.add()
        # What a crash leaves behind: whole ticks and no end.
        data = path.read_bytes()
    path.write_bytes(data)
    shown, twin = kuglice("replay", str(path)), kuglice("replay", str(path), "--json")
    assert shown.returncode == twin.returncode == 3
    assert (
        "equal as far as it goes, but not complete: the recording was cut off after 20 ticks" in shown.stdout
    )
    figures = json.loads(twin.stdout)
    assert figures["equal"]
    assert not figures["complete"]
    assert "with 3" in kuglice("replay", "--help").stdout


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
    assert "not a replay file: its first line is not 'kuglice replay'" in shown.stderr
    assert shown.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("bench wire --scene nope", "kuglice: scene 'nope': neither a file nor one of gas, rain"),
        ("bench network --link nope", "link 'nope': must be one of auto, tunnel, proxy"),
        ("render gas --out x.bmp", "kuglice: output x.bmp: must be a directory, or its suffix one of .mp4"),
    ],
)
def test_what_cannot_be_is_told_before_anything_is_done(command, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shown = kuglice(*command.split())
    assert (shown.returncode, shown.stdout) == (2, "")
    assert told in shown.stderr
    assert shown.stderr.strip("\n") == shown.stderr.rstrip("\n")
    assert not list(tmp_path.iterdir())


def test_a_place_that_cannot_be_written_is_one_line_and_exit_code_2(tmp_path):
    taken = tmp_path / "bench.json"
    taken.mkdir()
    shown = kuglice("bench", "--case", "each tick", "--repeats", "1", "--out", str(tmp_path))
    assert shown.returncode == 2
    assert f"kuglice: {taken}: Is a directory\n" in shown.stderr
    assert "Traceback" not in shown.stderr


def test_digits_are_grouped_in_counts_and_not_in_names(capsys):
    print_figures("", {"server": {"epoch": 1763787695123456789, "ticks": 12345}}, as_json=False)
    shown = capsys.readouterr().out
    assert "1763787695123456789" in shown
    assert "12,345" in shown


def test_several_numbers_are_shown_as_briefly_as_one(capsys):
    print_figures(
        "", {"view": {"rectangle": [219.67363152500184, 200.0, 12345.6], "none": []}}, as_json=False
    )
    shown = capsys.readouterr().out
    assert "220, 200, 12,346" in shown
