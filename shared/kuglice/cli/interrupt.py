"""Ctrl-C while modules are imported: the process ends, and says nothing."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["INTERRUPTED", "ended_by_interrupt"]

INTERRUPTED = 130
"""Exit code after Ctrl-C: what shells say for SIGINT."""


@contextmanager
def ended_by_interrupt() -> Iterator[None]:
    """There a KeyboardInterrupt would be shown by whoever catches it, or be lost in a callback of the import system.

    Nothing is open by then that would have to be closed.
    """
    in_main_thread = threading.current_thread() is threading.main_thread()
    if not in_main_thread or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        # No KeyboardInterrupt will come: to another thread, or where SIGINT is ignored, or heeded by somebody else.
        yield
        return
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
