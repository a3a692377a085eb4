"""The commands of LESSONS.md are run, and print what stands there."""

from __future__ import annotations

import doctest
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import kuglice.lab

TEXT = (Path(kuglice.lab.__file__).parent / "LESSONS.md").read_text()
LESSONS = re.findall(r"^## (.*?)\n(.*?)(?=^## |\Z)", TEXT, re.DOTALL | re.MULTILINE)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def commands(lesson: str) -> list[tuple[str, str]]:
    """Each of its commands, and what is printed under it."""
    blocks = re.findall(r"^```console\n(.*?)^```$", lesson, re.DOTALL | re.MULTILINE)
    parts = [part for block in blocks for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]]
    found = []
    for part in parts:
        first, *rest = part.splitlines(keepends=True)
        more = [line[2:] for line in rest if line.startswith("> ")]
        found.append((first + "".join(more), "".join(rest[len(more) :])))
    return found


@pytest.mark.parametrize("lesson", [text for _, text in LESSONS], ids=[title for title, _ in LESSONS])
def test_commands_print_what_is_told(lesson, tmp_path):
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    told = commands(lesson)
    assert told
    for command, printed in told:
        done = subprocess.run(
            ["bash", "-e", "-o", "pipefail", "-c", command],
            cwd=tmp_path,
            env={**os.environ, "PATH": path, "COLUMNS": "120"},
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
        )
        assert done.returncode == 0, f"{command}{done.stderr}"
        assert doctest.OutputChecker().check_output(printed, done.stdout, FLAGS), (
            f"{command}told:\n{printed}\nprinted:\n{done.stdout}"
        )
