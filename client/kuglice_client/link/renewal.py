"""When a link is opened anew: after a cut, first with the stream alone, and for the datagrams once all is well.

Zenoh would come back by itself, but later than one who tries again and again at short intervals (opening.py), without
the datagrams that were beside the stream, and with keys numbered anew, by which messages that come over two links are
mixed up: ticks were not heard again, inputs were heard as ticks.
"""

from __future__ import annotations

import logging

from kuglice_client.link.datagram_watch import DatagramWatch
from kuglice_client.link.link import Link

__all__ = ["Renewal"]

log = logging.getLogger(__name__)

PATIENCE_SECONDS = 1.5
"""Of a stream that stays silent while the server answers, or of datagrams that are dead."""
AGAIN_SECONDS = 10.0
DATAGRAM_TRIES = 3
"""In a row: what opens a link of datagrams is sent once, and lost like anything else; but some networks have none."""
LOOK_SECONDS = 0.25


class Renewal:
    """Of one link, from outside: it looks, waits, and asks for another session."""

    def __init__(self, link: Link, datagrams: DatagramWatch) -> None:
        self._link = link
        self._datagrams = datagrams
        self._since: float | None = None
        self._not_before = 0.0
        self._look_at = 0.0
        self._tries = 0
        self.renewals = 0

    def turn(self, now: float, *, silent: bool, answered: bool, busy: bool) -> bool:
        """`silent`: the stream brings nothing. `answered`: the server has just answered a question.

        `busy`: what the link brings just now is waited for. Whether the link has been opened anew since.
        """
        self._datagrams.turn(now)
        renewed = self._link.renewed()
        if renewed:
            self.renewals += 1
            self._datagrams.renewed()
            log.info("the link was opened anew")
        if self._link.owes_datagrams and not silent and not busy:
            self._link.begin_renewal()
        self._judge(now, silent=silent, answered=answered)
        return renewed

    def _judge(self, now: float, *, silent: bool, answered: bool) -> None:
        if silent and now >= self._look_at:
            self._look_at = now + LOOK_SECONDS
            self._link.renew_if_lost()
        if self._datagrams.up:
            self._tries = 0
        missing = self._datagrams.missing and self._tries < DATAGRAM_TRIES
        if not missing and not (silent and (answered or self._since is not None)):
            self._since = None
            return
        if self._since is None:
            self._since = now
        if now - self._since < PATIENCE_SECONDS:
            return
        if missing:
            self._tries += 1
        elif now < self._not_before:
            return
        self._since, self._not_before = None, now + AGAIN_SECONDS
        self._link.begin_renewal()
