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

from kuglice.aside import aside
from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import close_session, lacks_stream, nobody_answers, open_session

__all__ = ["Opening"]

log = logging.getLogger(__name__)

STAGGER_SECONDS = 0.3
"""From one try to the next, where the first takes its time. On a good link it is over before."""
RETRY_SECONDS = 0.1
"""Where tries fail at once: nobody listens yet."""
TRIES = 5
"""At a time."""
POLL_SECONDS = 0.005
WHOLE_TRY_SECONDS = 1.5
"""For the first try, whatever the deadline: whoever does not want to wait wants to know whether somebody is there."""


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
        self._first_until = time.monotonic() + WHOLE_TRY_SECONDS
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
        aside(self._try, "open zenoh session")
        return None

    def wait(self, deadline: float, stop: threading.Event) -> zenoh.Session:
        """The session, waited for. Raises JoinError at the deadline, in seconds, or when `stop` is set.

        A deadline that is over sooner than the first try is over with it.
        """
        try:
            while (session := self.poll(now := time.monotonic())) is None:
                if stop.wait(POLL_SECONDS):
                    raise JoinError("stopped while connecting")
                if now > deadline and (self.failure is not None or now > self._first_until):
                    raise JoinError(nobody_answers(self._configuration)) from self.failure
        except BaseException:
            self.end()
            raise
        return session

    def end(self) -> None:
        """Whatever opens from now on is closed again."""
        with self._lock:
            session, self._session, self._over = self._session, None, True
        if session is not None:
            close_session(session, [], timeout=0.0)

    def _try(self) -> None:
        try:
            session = open_session(self._configuration)
            crippled = lacks_stream(session)
            with self._lock:
                is_taken = not crippled and not self._over and self._session is None
                if is_taken:
                    self._session = session
            if not is_taken:
                # Closing takes 5 s on a bad link, in which another try may be open.
                close_session(session, [], timeout=0.0)
            if crippled:
                raise ProtocolError("only datagrams came up, and questions need a stream")
        except ProtocolError as error:
            log.debug("%s", error)
            with self._lock:
                self.failure = error
        finally:
            with self._lock:
                self.under_way -= 1
