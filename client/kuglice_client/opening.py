"""Opening a session: several tries, each begun before the one before it has failed; the first that is open is taken.

What opens a link is lost like anything else, and is sent again only after a second (TCP) or not at all (datagrams): on
a bad network one try in ten takes a second longer than the others. When a link comes back after a cut, a try of just
then is the quickest.
"""

from __future__ import annotations

import logging
import threading
import time
from typing import Any

import zenoh

from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import close_session, nobody_answers, open_session

__all__ = ["Opening"]

log = logging.getLogger(__name__)

STAGGER_SECONDS = 0.3
"""From one try to the next, where the first takes its time. On a good link it is over before."""
RETRY_SECONDS = 0.1
"""Where tries fail at once: nobody listens yet."""
TRIES = 5
"""At a time."""
POLL_SECONDS = 0.005


class Opening:
    """Begins with the first try when made; `poll` goes on with it, and `end` gives up."""

    def __init__(self, configuration: dict[str, Any]) -> None:
        self._configuration = configuration
        self._lock = threading.Lock()
        self._session: zenoh.Session | None = None
        self._over = False
        self.under_way = 0
        """Tries."""
        self._begun_at = float("-inf")
        self.tries = 0
        self.failure: ProtocolError | None = None
        """Why the last try failed that did."""
        self.poll(time.monotonic())

    def poll(self, now: float) -> zenoh.Session | None:
        """The session, once it is open; it is the caller's then. Until then, begins the next try when it is due."""
        with self._lock:
            if self._session is not None:
                session, self._session, self._over = self._session, None, True
                return session
            since = now - self._begun_at
            due = since >= (STAGGER_SECONDS if self.under_way else RETRY_SECONDS)
            if self._over or self.under_way >= TRIES or not due:
                return None
            self.under_way += 1
            self._begun_at = now
            self.tries += 1
        threading.Thread(target=self._try, name="open zenoh session", daemon=True).start()
        return None

    def wait(self, deadline: float, stop: threading.Event) -> zenoh.Session:
        """The session, waited for. Raises JoinError at the deadline, in seconds, or when `stop` is set."""
        while (session := self.poll(now := time.monotonic())) is None:
            if now > deadline or stop.wait(POLL_SECONDS):
                self.end()
                why = "stopped while connecting" if stop.is_set() else nobody_answers(self._configuration)
                raise JoinError(why) from self.failure
        return session

    def end(self) -> None:
        """Whatever opens from now on is closed again."""
        with self._lock:
            session, self._session, self._over = self._session, None, True
        if session is not None:
            close_session(session, [], timeout=0.0)

    def _try(self) -> None:
        session, failure = None, None
        try:
            session = open_session(self._configuration)
        except ProtocolError as error:
            log.debug("%s", error)
            failure = error
        with self._lock:
            self.failure = failure or self.failure
            if session is not None and not self._over and self._session is None:
                self._session, session = session, None
        if session is not None:
            # Another was quicker.
            close_session(session, [])
        with self._lock:
            self.under_way -= 1
