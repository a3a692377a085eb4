"""Questions of those who have just shown themselves, answered once it is clear whether they play.

The tick that lets somebody in, or refuses it, comes soon, but not for everybody: one whose name is kept for another
session is told so after a moment. All wait beside each other, so that one that waits in vain delays nobody.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

import zenoh

__all__ = ["Arrivals"]

log = logging.getLogger(__name__)

SETTLE_SECONDS = 0.1
"""How long one who has just shown itself is waited for; one who is not let in by then asks again."""
MOST_WAITING = 1024
"""Whoever asks beyond that is answered at once."""


@dataclass(frozen=True, eq=False)
class _Waiting:
    name: str
    session: str
    until: float
    answer: Callable[[], None]


class Arrivals:
    """`settled`: whether that name and session play, or were refused. It is called in any thread; who waits is answered
    in one of this object's own, which `undeclare` ends.
    """

    def __init__(self, settled: Callable[[str, str], bool]) -> None:
        self._settled = settled
        self._waiting: list[_Waiting] = []
        self._over = False
        self._lock = threading.Lock()
        self._stirred = threading.Event()
        self._thread = threading.Thread(target=self._run, name="arrivals", daemon=True)
        self._thread.start()

    def answer(self, name: str, session: str, answer: Callable[[], None]) -> None:
        """Call `answer` at once if that is settled, else once it is, or has taken too long."""
        if self._settled(name, session):
            answer()
            return
        waiting = _Waiting(name, session, time.monotonic() + SETTLE_SECONDS, answer)
        with self._lock:
            room = not self._over and len(self._waiting) < MOST_WAITING
            if room:
                self._waiting.append(waiting)
        if room:
            self._stirred.set()
        else:
            answer()

    def ticked(self) -> None:
        """Something may be settled that was not."""
        if self._waiting:
            self._stirred.set()

    def undeclare(self) -> None:
        """Answer all who wait, and end."""
        with self._lock:
            self._over = True
        self._stirred.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._over:
            until = min((one.until for one in self._taken()), default=None)
            self._stirred.wait(None if until is None else max(0.0, until - time.monotonic()))
            self._stirred.clear()
            self._answer(self._is_due)
        self._answer(lambda one: True)

    def _is_due(self, one: _Waiting) -> bool:
        return time.monotonic() >= one.until or self._settled(one.name, one.session)

    def _taken(self) -> list[_Waiting]:
        with self._lock:
            return list(self._waiting)

    def _answer(self, is_due: Callable[[_Waiting], bool]) -> None:
        # Without the lock: whoever asks next must not wait for an answer to others.
        due = [one for one in self._taken() if is_due(one)]
        answered = set(due)
        with self._lock:
            self._waiting = [one for one in self._waiting if one not in answered]
        for one in due:
            try:
                one.answer()
            except zenoh.ZError as error:
                # Its link is gone; the others wait still.
                log.error("an arrival is not answered: %s", error)
