"""SIGINT and SIGTERM as an event, so that long commands finish what they hold."""

from __future__ import annotations

import os
import queue
import signal
import threading
import time
from types import FrameType

__all__ = ["stop_on_signals"]

ECHO_SECONDS = 1.0


def stop_on_signals() -> threading.Event:
    """An event that the first SIGINT or SIGTERM sets; a later one ends the process at once.

    What follows within a second is the first one again: `timeout` signals its child and then the whole group.
    """
    stop = threading.Event()
    first: list[float] = []
    # A handler interrupts the main thread anywhere, so also where that holds the lock of the event, which `set` would
    # then wait for, for ever. This queue may be put into from a handler, and another thread may wait for the lock.
    said: queue.SimpleQueue[int] = queue.SimpleQueue()

    def heed() -> None:
        said.get()
        stop.set()

    threading.Thread(target=heed, name="heed signals", daemon=True).start()

    def note(number: int, _: FrameType | None) -> None:
        said.put(number)
        first.append(time.monotonic())
        if first[-1] - first[0] > ECHO_SECONDS:
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, note)
    return stop
