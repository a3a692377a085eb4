"""Regression: Ctrl-C in the first half second of a command showed a traceback from inside an import, since the
package was imported before the command line took care of anything."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest

SIGNAL_ON_IMPORT = """
import importlib.abc, os, signal, sys

class Interrupt(importlib.abc.MetaPathFinder):
    def find_spec(self, name, *_):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupt())
"""
HEEDED = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
"""As in a terminal: what a script starts in the background ignores interrupts, and so do the tests within."""
RUN = "from kuglice.cli import main; print('here', flush=True); main()"


def command(*words: str, before: str = "") -> subprocess.Popen[str]:
    code = [sys.executable, "-c", HEEDED + before + RUN, *words]
    return subprocess.Popen(code, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize(
    "module", ["kuglice.cli.app", "typer", "numpy", "zenoh", "kuglice.scene", "kuglice_server.server"]
)
def test_an_interrupt_in_the_midst_of_an_import_ends_quietly_with_130(module):
    with command("server", "cradle", before=SIGNAL_ON_IMPORT.format(module=module)) as process:
        try:
            assert process.communicate(timeout=60) == ("here\n", "")
        finally:
            process.kill()
    assert process.returncode == 130


@pytest.mark.parametrize("after", [0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4])
def test_an_interrupt_at_any_moment_shows_no_traceback(after):
    process = command("plan", "rain")
    assert process.stdout is not None
    assert process.stdout.readline() == "here\n"
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert said == ""
    # It may have been done before, or be ending.
    assert process.returncode in {130, 0, -signal.SIGINT}


@pytest.mark.parametrize("handler", ["default_int_handler", "SIG_IGN", "SIG_DFL"])
def test_afterwards_an_interrupt_is_what_it_was(handler):
    code = f"""
import signal
from kuglice.cli.interrupt import ended_by_interrupt
signal.signal(signal.SIGINT, signal.{handler})
with ended_by_interrupt():
    within = signal.getsignal(signal.SIGINT)
print(within is signal.{handler}, signal.getsignal(signal.SIGINT) is signal.{handler})
"""
    taken = subprocess.check_output([sys.executable, "-c", code], text=True, timeout=60)
    assert taken == f"{handler != 'default_int_handler'} True\n"


def test_an_interrupt_while_a_process_that_is_done_is_taken_down_is_not_shown():
    last = "import atexit, os, signal; atexit.register(lambda: os.kill(os.getpid(), signal.SIGINT));"
    process = command("--version", before=last)
    _, said = process.communicate(timeout=60)
    assert said == ""
    assert process.returncode == -signal.SIGINT
