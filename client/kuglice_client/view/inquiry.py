"""What the server says about the world for views: asked for at the start, and again where things look different."""

from __future__ import annotations

import logging
import time

from kuglice import _core
from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import Keys, Payload, ViewAbout, decode
from kuglice_client.link import Asked, Link, NotYetError, Waiting

__all__ = ["Inquiry"]

log = logging.getLogger(__name__)

AGAIN_SECONDS = 1.0
TIMEOUT_SECONDS = 1.0
"""What is asked into the void is not waited for any longer."""


class Inquiry:
    """One question at a time."""

    def __init__(self, link: Link, keys: Keys) -> None:
        self._link = link
        self._keys = keys
        self._asked: Asked | None = None
        self._asked_at = time.monotonic()

    def wait(self, waiting: Waiting) -> ViewAbout:
        """The answer, asked for until there is one.

        Raises JoinError if there is none in time, or the server speaks or steps otherwise.
        """

        def attempt() -> Payload:
            asked = self._link.ask(self._keys.view, None, timeout=waiting.answer_seconds())
            try:
                return asked.wait(waiting.stop)[0]
            except JoinError as error:
                raise NotYetError(f"world {self._keys.world} at {self._link.endpoints}: {error}") from error

        return self._read(waiting.until_done(attempt))

    def ask(self, now: float) -> None:
        """Unless that was done just now."""
        if self._asked is None and now - self._asked_at > AGAIN_SECONDS:
            self._asked = self._link.ask(self._keys.view, None, timeout=TIMEOUT_SECONDS)
            self._asked_at = now

    def answer(self) -> ViewAbout | None:
        """What was asked, once; None if nothing was, or there is no answer yet, or none will come.

        Raises JoinError for a server that speaks or steps otherwise: looking on would be in vain.
        """
        if self._asked is None:
            return None
        try:
            replies = self._asked.poll()
        except JoinError as error:
            log.debug("nobody says what runs now: %s", error)
            self._asked = None
            return None
        if replies is None:
            return None
        self._asked = None
        return self._read(replies[0])

    def _read(self, reply: Payload) -> ViewAbout:
        try:
            about = decode(reply, ViewAbout)
        except ProtocolError as error:
            raise JoinError(f"{self._keys.view}: {error}") from error
        if about.step_version != _core.STEP_VERSION:
            raise JoinError(
                f"step version {about.step_version} of the server (kuglice {about.version}): this view has "
                f"{_core.STEP_VERSION} and would compute something else"
            )
        return about
