"""What the stream says and nobody would expect is believed once the server, asked for it, says so too.

Anybody may be on the way, and a tick of another run, or of next year, costs nothing to send. A server that was really
started again is a question later in being found out.
"""

from __future__ import annotations

import logging

from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import Keys, Status, Tick, decode
from kuglice_client.join import Joined
from kuglice_client.link import Asked, Link

__all__ = ["Credibility"]

log = logging.getLogger(__name__)

AGAIN_SECONDS = 1.0
"""From one question to the next, however much is doubted."""
TIMEOUT_SECONDS = 2.0
SLACK_SECONDS = 2.0
"""By which a tick may come before its time: what said when that is was on its way."""
FASTER = 1.01
"""Than agreed, as two clocks may differ."""


class Credibility:
    """Of what comes as the tick stream of the run that was `joined`."""

    def __init__(self, link: Link, keys: Keys, joined: Joined) -> None:
        self._link = link
        self._keys = keys
        self._epoch = joined.epoch
        self._rate = joined.about.rate
        self._tick, self._at = joined.told_tick, joined.told_at
        self._slack = SLACK_SECONDS + joined.round_trip
        self._in_doubt = False
        self._asked: Asked | None = None
        self._not_before = 0.0
        self.disbelieved = 0
        self.restarted = False
        """Whether the server says that it is another run by now."""

    def believes(self, message: Tick, now: float) -> bool:
        """Whether to take it in; if not, the server is to be asked."""
        latest = self._tick + ((now - self._at) * FASTER + self._slack) * self._rate
        if message.epoch == self._epoch and message.end <= latest:
            return True
        self.disbelieved += 1
        if self.disbelieved == 1:
            log.warning(
                "a message of epoch %d, tick %d, is not what the server would say now: it is asked (further ones are "
                "only counted)",
                message.epoch,
                message.end - 1,
            )
        self._in_doubt = True
        return False

    def turn(self, now: float) -> None:
        """Ask where there is doubt, or hear the answer."""
        if self._asked is None:
            if self._in_doubt and now >= self._not_before:
                self._in_doubt, self._not_before = False, now + AGAIN_SECONDS
                self._asked = self._link.ask(self._keys.status, None, timeout=TIMEOUT_SECONDS)
            return
        try:
            replies = self._asked.poll()
            if replies is None:
                return
            status = decode(replies[0], Status)
        except (JoinError, ProtocolError) as error:
            log.debug("%s", error)
            # One who does not answer is doubted on: it may be starting again just now.
            self._asked, self._in_doubt = None, True
            return
        self._asked = None
        self.restarted = status.epoch != self._epoch
        if not self.restarted:
            self._tick, self._at = status.tick, now
