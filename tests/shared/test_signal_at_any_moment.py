"""Regression: once in some hundred endings a client never ended. Its signal had come while the main thread, in
`stop.wait`, held the lock of the event that the handler then waited for; a second signal waited for it too."""

from __future__ import annotations

import subprocess
import sys

ROUNDS = 100
"""Without the mending, half of all runs hang within two."""
COMMAND = f"""
import os, signal, threading
from kuglice.cli.stop import stop_on_signals

for _ in range({ROUNDS}):
    stop = stop_on_signals()
    threading.Timer(0.001, os.kill, (os.getpid(), signal.SIGINT)).start()
    while not stop.is_set():
        stop.wait(0)
print("finished")
"""


def test_a_signal_is_heeded_whatever_the_main_thread_is_doing():
    words = [sys.executable, "-c", COMMAND]
    assert subprocess.check_output(words, text=True, timeout=60) == "finished\n"
