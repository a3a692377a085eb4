"""Signals: the first one lets a command finish, its echo too, and a later one ends it at once."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

COMMAND = """
import time
from kuglice.cli import stop as room

room.ECHO_SECONDS = {echo}
stop = room.stop_on_signals()
print("ready", flush=True)
stop.wait(60)
print("stopping", flush=True)
time.sleep({finishing})
print("finished", flush=True)
"""


def run(*, finishing: float, echo: float) -> subprocess.Popen[str]:
    words = [sys.executable, "-c", COMMAND.format(finishing=finishing, echo=echo)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    return process


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_that_comes_twice_at_once_lets_the_command_finish(number):
    process = run(finishing=0.3, echo=3600.0)
    process.send_signal(number)
    assert process.stdout.readline() == "stopping\n"
    process.send_signal(number)
    assert process.communicate(timeout=60)[0] == "finished\n"
    assert process.returncode == 0


def test_one_who_does_not_finish_is_ended_by_a_later_signal():
    process = run(finishing=60.0, echo=0.5)
    process.send_signal(signal.SIGTERM)
    assert process.stdout.readline() == "stopping\n"
    for _ in range(40):
        process.send_signal(signal.SIGTERM)
        try:
            process.wait(0.25)
            break
        except subprocess.TimeoutExpired:
            continue
    process.communicate(timeout=60)
    assert process.returncode == -signal.SIGTERM
