"""Waiting for a server: what it does not answer as it should is asked again, over another link if need be."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import TypeVar

from kuglice.errors import JoinError
from kuglice_client.link.link import Link

__all__ = ["NotYetError", "Waiting"]

log = logging.getLogger(__name__)

T = TypeVar("T")

RETRY_SECONDS = 0.03
SHORTEST_SECONDS = 0.001
"""That Zenoh is told to wait: none might mean without end."""
ANSWER_SECONDS = 5.0
LEAST_SECONDS = 1.0
"""Once there is a link, whatever the bound: whoever does not want to wait wants to know whether it can be joined."""
FAIR_SECONDS = 0.5
"""Who was given less to answer in, at the very end, tells nothing by its silence."""


class NotYetError(JoinError):
    """A reason that time may heal."""


class Waiting:
    """Until `wait` seconds after `began`, in seconds of the monotonic clock, or until `stop` is set.

    All questions of a join are asked within that; where the link took it all to open, within a second from now on.
    """

    def __init__(self, link: Link, *, began: float, wait: float, stop: threading.Event) -> None:
        self.link = link
        self.stop = stop
        self._wait = wait
        self._deadline = max(began + wait, time.monotonic() + LEAST_SECONDS)
        self._asked_late = False
        self._why: str | None = None

    def until_done(self, attempt: Callable[[], T]) -> T:
        """What `attempt` returns, once it does not raise NotYetError. Raises JoinError when that is not waited for."""
        while True:
            try:
                return attempt()
            except NotYetError as error:
                log.debug("not yet: %s", error)
                self.pause(why=str(error))

    def pause(self, why: str) -> None:
        """Before the next attempt: a moment, in which a link that is lost is replaced.

        Raises JoinError with `why`, and with the bound, when the time is over.
        """
        if self._why is None or not self._asked_late:
            self._why = why
        if self.stop.wait(RETRY_SECONDS):
            raise JoinError("stopped while joining")
        if time.monotonic() > self._deadline:
            raise JoinError(f"{self._why}; not joined within {self._wait:g} s (--wait)")
        if not self.link.renewed():
            self.link.renew_if_lost()

    def answer_seconds(self, at_most: float = ANSWER_SECONDS) -> float:
        """To wait for one answer that is asked for now: what is left, and `at_most` that before it is asked again."""
        left = self._deadline - time.monotonic()
        self._asked_late = left < FAIR_SECONDS
        return max(SHORTEST_SECONDS, min(at_most, left))
