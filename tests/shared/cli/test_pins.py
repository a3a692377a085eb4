"""Options that insist on parts of the model, like the table [model] of a scene."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

import kuglice as kg
from kuglice.cli.pins import pinned
from kuglice.errors import SceneError

DROP = """
box = [0, 0, 10, 10]
restitution = 0.5
[model]
contacts = "overlap"
substeps = 2
[[forces]]
kind = "gravity"
x = 0.0
y = -10.0
[[groups]]
layout = "listed"
position = [[5.0, 3.0]]
radius = 0.5
"""


def kuglice(*arguments: object) -> subprocess.CompletedProcess[str]:
    """A process of its own, since these commands end on signals."""
    return subprocess.run(
        [sys.executable, "-m", "kuglice", *map(str, arguments)], capture_output=True, text=True, check=False
    )


def told(*arguments: object) -> dict:
    done = kuglice(*arguments, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture
def drop(tmp_path):
    path = tmp_path / "drop.toml"
    path.write_text(DROP)
    return path


def test_win_over_those_of_the_scene_which_stay_otherwise(drop):
    plan = told("plan", drop, "--contacts", "backtrack", "--integrator", "rk4")
    assert (plan["integrator"], plan["contacts"], plan["substeps"]) == ("rk4", "backtrack", 2)
    assert "contacts backtrack: pinned by the scene." in plan["reasons"]


def test_films_of_two_methods_end_in_two_states(drop, tmp_path):
    films = {}
    for contacts in ("overlap", "event"):
        options = ["--contacts", contacts, "--substeps", 1, "--seconds", 2, "--size", "64x64"]
        films[contacts] = told("render", drop, *options, "--out", tmp_path / contacts / "frame.png")
    assert "verlet x event" in films["event"]["model"]
    assert "overlap" in films["overlap"]["model"]
    assert films["overlap"]["state_hash"] != films["event"]["state_hash"]


@pytest.mark.parametrize("command", [["render", "--out", "film.mp4"], ["server"], ["plan"]])
def test_a_name_that_is_none_is_refused_by_every_command(tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    done = kuglice(*command, "gas:n=5", "--contacts", "sticky")
    assert done.returncode == 2
    assert "contacts = 'sticky': must be one of overlap" in done.stderr.replace('"', "'")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"integrator": "runge"}, "integrator = .* must be one of euler"),
        ({"broadphase": "grid"}, "broadphase = .* must be one of brute"),
        ({"substeps": 0}, "substeps = 0"),
    ],
)
def test_what_is_no_such_part_is_refused(options, message):
    parts = dict.fromkeys(("integrator", "contacts", "substeps", "broadphase")) | options
    with pytest.raises(SceneError, match=message):
        pinned(kg.scenes.gas(n=5), **parts)


def test_parts_that_do_not_go_together_are_refused(drop):
    done = kuglice("plan", drop, "--integrator", "rk4", "--contacts", "event")
    assert done.returncode == 2
    assert "cannot be paired" in done.stderr
