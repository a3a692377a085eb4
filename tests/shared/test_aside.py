"""What nobody has to wait for is waited for a moment at the end of a process, and holds no command up for longer."""

from __future__ import annotations

import subprocess
import sys

HANGING = """
import sys, threading, time
from kuglice.aside import aside
from kuglice.cli import main

aside(threading.Event().wait, "hangs")
# As Zenoh's are that call back: Python would wait for them for ever.
threading.Thread(target=threading.Event().wait).start()
sys.argv = ["kuglice", "scenes", {scene!r}]
main()
"""
WAITED_FOR = """
import time
from kuglice.aside import aside, under_way

aside(lambda: (time.sleep(0.5), print("done")), "slow")
print(under_way())
"""


def run(program: str) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-c", program]
    return subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)


def test_a_command_that_is_done_ends_though_something_hangs_and_all_that_it_said_is_told():
    ended = run(HANGING.format(scene="gas"))
    assert (ended.returncode, ended.stderr) == (0, "")
    assert "gas" in ended.stdout


def test_its_status_is_that_of_the_command():
    ended = run(HANGING.format(scene="nothing"))
    assert ended.returncode == 2
    assert "nothing" in ended.stderr


def test_what_is_over_soon_is_waited_for():
    ended = run(WAITED_FOR)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert ended.stdout == "['slow']\ndone\n"
