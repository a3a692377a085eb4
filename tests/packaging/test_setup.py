"""A machine that lacks something is told what, and the command that installs it, in one sentence."""

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ALWAYS_THERE = ("bash", "cat", "dirname", "env", "sh")
HERE = f'exec {sys.executable} "$@"'

Machine = Callable[[dict[str, str]], str]


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    """What .ci/setup says where these programs are all there is; it never comes as far as to install."""

    def say(programs: dict[str, str]) -> str:
        path = tmp_path / "bin"
        path.mkdir()
        for name in ALWAYS_THERE:
            (path / name).symlink_to(shutil.which(name))
        for name, script in programs.items():
            (path / name).write_text(f"#!/bin/sh\n{script}\n")
            (path / name).chmod(0o755)
        setup = tmp_path / ".ci" / "setup"
        setup.parent.mkdir()
        shutil.copy2(ROOT / ".ci" / "setup", setup)
        done = subprocess.run(
            ["bash", str(setup)],
            env={"PATH": str(path)},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode != 0
        assert done.stdout == ""
        assert not (tmp_path / ".venv").exists()
        return done.stderr

    return say


@pytest.mark.parametrize(
    ("programs", "lacks", "command"),
    [
        pytest.param({}, "Python 3.11 or newer", "apt-get install python3", id="no python"),
        pytest.param(
            {"python3": "exit 1"}, "Python 3.11 or newer", "apt-get install python3", id="old python"
        ),
        pytest.param(
            {"python3": f'case "$*" in *ensurepip*) exit 1;; esac; {HERE}'},
            "cannot make virtual environments",
            "apt-get install python3-venv",
            id="no venv",
        ),
        pytest.param({"python3": HERE}, "a Rust toolchain", "rustup", id="no cargo"),
        pytest.param(
            {"python3": HERE, "cargo": "echo cargo 1.84.1"},
            "cargo 1.88 or newer and found 'cargo 1.84.1'",
            "rustup update stable",
            id="old cargo",
        ),
        pytest.param(
            {"python3": HERE, "cargo": "echo cargo 1.100.0"}, "no 'cc'", "apt-get install gcc", id="no linker"
        ),
    ],
)
def test_what_is_missing_is_said_in_one_sentence_with_the_command(
    machine: Machine, programs: dict[str, str], lacks: str, command: str
) -> None:
    said = machine(programs)
    assert lacks in said
    assert command in said
    assert len(said.splitlines()) == 1
