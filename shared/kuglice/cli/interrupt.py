"""Ctrl-C while modules are imported, and while a process that is done is taken down: it ends, and says nothing."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["INTERRUPTED", "end_on_interrupt", "ended_by_interrupt"]

INTERRUPTED = 130
"""Exit code after Ctrl-C: what shells say for SIGINT."""


@contextmanager
def ended_by_interrupt() -> Iterator[None]:
    """There a KeyboardInterrupt would be shown by whoever catches it, or be lost in a callback of the import system.

    Nothing is open by then that would have to be closed.
    """
    if not _interrupts():
        yield
        return
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def end_on_interrupt() -> None:
    """For the end of a process, where a KeyboardInterrupt would come in the midst of what tidies up, and be shown."""
    if _interrupts():
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def _interrupts() -> bool:
    """Whether a KeyboardInterrupt may come: not in another thread, nor where SIGINT is ignored, or is heeded."""
    in_main_thread = threading.current_thread() is threading.main_thread()
    return in_main_thread and signal.getsignal(signal.SIGINT) is signal.default_int_handler
