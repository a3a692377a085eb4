"""Questions for whole states, answered one after the other in a thread of their own.

A state of now is made by the next tick, which may be long in coming, and a large one takes its time to be compressed.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from kuglice.errors import ProtocolError
from kuglice_server.beside import Beside

__all__ = ["Snapshots"]

MOST_WAITING = 256
"""Whoever asks beyond that is refused, and asks again."""


class Snapshots:
    """`undeclare` ends its thread."""

    def __init__(self) -> None:
        self._thread = Beside("snapshots")
        self._room = threading.Semaphore(MOST_WAITING)

    def answer(self, answer: Callable[[], None]) -> None:
        """Call `answer` after those that came before. Raises ProtocolError where too many wait, or at the end."""
        if not self._room.acquire(blocking=False):
            raise ProtocolError(
                f"snapshot: {MOST_WAITING} wait for one already, at most {MOST_WAITING} allowed"
            )
        try:
            self._thread.submit(self._run, answer)
        except RuntimeError:
            raise ProtocolError("snapshot: this server ends") from None

    def undeclare(self) -> None:
        """Leave those who still wait without an answer, and end."""
        self._thread.undeclare()

    def _run(self, answer: Callable[[], None]) -> None:
        try:
            answer()
        finally:
            self._room.release()
