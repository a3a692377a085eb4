"""Regression: a command that ended by SystemExit with a text, while Zenoh was still at something, lost the text."""

from __future__ import annotations

import subprocess
import sys

import pytest

COMMAND = """
import sys, threading
import kuglice.cli.app
from kuglice.aside import aside
from kuglice.cli import main

def build():
    def command(**_):
        aside(threading.Event().wait, "for ever")
        print("before")
        raise SystemExit({code!r})
    return command

kuglice.cli.app.build = build
main()
"""


@pytest.mark.parametrize(
    ("code", "status", "told"),
    [("no such world", 1, "no such world\n"), (None, 0, ""), (0, 0, ""), (7, 7, "")],
)
def test_a_command_that_leaves_ends_as_python_would(code, status, told):
    ended = subprocess.run(
        [sys.executable, "-c", COMMAND.format(code=code)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (status, "before\n", told)
