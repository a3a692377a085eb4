"""Calls that may take long, or for ever, in threads that nobody has to wait for.

A thread that comes back into Python while the interpreter is being taken down brings the whole process down with
"FATAL: exception not rethrown", status 134, if there is foreign code beneath it, as in Zenoh. Clients that were stopped
while they connected ended so. Hence a process waits a little for such threads at its end, or leaves without any end
(cli/__init__.py).
"""

from __future__ import annotations

import atexit
import threading
import time
from collections.abc import Callable

__all__ = ["aside", "under_way"]

PATIENCE_SECONDS = 3.0
"""At the end of a process. A try to open a session takes half as long at most."""

_threads: set[threading.Thread] = set()
_lock = threading.Lock()


def aside(call: Callable[[], object], name: str) -> threading.Thread:
    """Begin `call` in a daemon thread of that name."""
    thread = threading.Thread(target=call, name=name, daemon=True)
    with _lock:
        _threads.difference_update([one for one in _threads if not one.is_alive()])
        thread.start()
        _threads.add(thread)
    return thread


def under_way() -> list[str]:
    """Names of the threads that run still."""
    with _lock:
        return [one.name for one in _threads if one.is_alive()]


@atexit.register
def _wait() -> None:
    deadline = time.monotonic() + PATIENCE_SECONDS
    with _lock:
        waited_for = list(_threads)
    for thread in waited_for:
        thread.join(max(0.0, deadline - time.monotonic()))
