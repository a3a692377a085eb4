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
ANSWER_SECONDS = 5.0
LEAST_ANSWER_SECONDS = 1.0


class NotYetError(JoinError):
    """A reason that time may heal."""


class Waiting:
    """Until `deadline`, in seconds of the monotonic clock, or until `stop` is set."""

    def __init__(self, link: Link, *, deadline: float, stop: threading.Event) -> None:
        self.link = link
        self.stop = stop
        self._deadline = deadline

    def until_done(self, attempt: Callable[[], T]) -> T:
        """What `attempt` returns, once it does not raise NotYetError. Raises JoinError when that is not waited for."""
        while True:
            try:
                return attempt()
            except NotYetError as error:
                log.debug("not yet: %s", error)
                self.pause(why=str(error))

    def pause(self, why: str) -> None:
        """Before the next attempt: a moment, in which a link that is lost is replaced. Raises JoinError with `why`."""
        if self.stop.wait(RETRY_SECONDS):
            raise JoinError("stopped while joining")
        if time.monotonic() > self._deadline:
            raise JoinError(why)
        if not self.link.renewed():
            self.link.renew_if_lost()

    @property
    def answer_seconds(self) -> float:
        """To wait for one answer: until the deadline, but a second at least, and not for ever."""
        return max(LEAST_ANSWER_SECONDS, min(ANSWER_SECONDS, self._deadline - time.monotonic()))
