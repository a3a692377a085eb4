"""Questions for whole states, answered in threads of their own.

A state of now is made by the next tick, which may be long in coming, and a large one takes its time to be compressed,
and to be put into a link: longer than a round trip, and on a stalled one for seconds. Nobody waits for another's link.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from kuglice.errors import ProtocolError
from kuglice.protocol import compress
from kuglice_server.beside import Beside
from kuglice_server.history import KeptSnapshot

__all__ = ["Snapshots"]

THREADS = 16
MOST_WAITING = 256
"""Whoever asks beyond that is refused, and asks again."""


class Snapshots:
    """`undeclare` ends its threads."""

    def __init__(self) -> None:
        self._threads = Beside("snapshots", THREADS)
        self._packing = threading.Lock()
        self._packed: tuple[KeptSnapshot, bytes] | None = None
        self._room = threading.Semaphore(MOST_WAITING)

    def answer(self, answer: Callable[[], None]) -> None:
        """Call `answer`, elsewhere and soon. Raises ProtocolError where too many wait, or at the end."""
        if not self._room.acquire(blocking=False):
            raise ProtocolError(
                f"snapshot: {MOST_WAITING} wait for one already, at most {MOST_WAITING} allowed"
            )
        try:
            self._threads.submit(self._run, answer)
        except RuntimeError:
            raise ProtocolError("snapshot: this server ends") from None

    def packed(self, kept: KeptSnapshot) -> bytes:
        """A state, compressed; once for all who ask at the same time, as many do whose link was cut together."""
        with self._packing:
            if self._packed is None or self._packed[0] is not kept:
                self._packed = kept, compress(kept.data, numbers=True)
            return self._packed[1]

    def undeclare(self) -> None:
        """Leave those who still wait without an answer, and end."""
        self._threads.undeclare()

    def _run(self, answer: Callable[[], None]) -> None:
        try:
            answer()
        finally:
            self._room.release()
