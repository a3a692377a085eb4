"""Whether stream and datagrams get through, where both are wanted: told when that changes, and once."""

from __future__ import annotations

import logging
import time

from kuglice_client.link.link import Link

__all__ = ["DatagramWatch"]

log = logging.getLogger(__name__)

FIRST_SECONDS = 4.0
"""After which a link that nobody answers on has been given up."""
RENEWED_SECONDS = 2.0
"""A link that does come up has done so by then, where nothing has to be waited for but it."""
EVERY_SECONDS = 1.0
GLANCE_SECONDS = 0.1


class DatagramWatch:
    """Warns where a client has to make do with one of the two: later ticks and inputs, but nothing wrong."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._look_at = time.monotonic() + FIRST_SECONDS
        self._glance_at = 0.0
        self._were_up: bool | None = None
        self.missing = False
        """Whether one of the two did not get through when last looked at."""

    @property
    def up(self) -> bool:
        """Whether both got through when last looked at."""
        return bool(self._were_up) and not self.missing

    def renewed(self) -> None:
        """The link was opened anew: they have their time to come up."""
        self.missing = False
        self._look_at = time.monotonic() + RENEWED_SECONDS

    def turn(self, now: float) -> None:
        """Look, now and then."""
        if not self._link.wants_datagrams or self._link.owes_datagrams:
            return
        if now < min(self._look_at, self._glance_at):
            return
        kinds = self._link.kinds
        if now < self._look_at:
            # Too early to miss what is not there; but what was there has come up.
            self._glance_at = now + GLANCE_SECONDS if len(kinds) < 2 else self._look_at
            self._were_up = True if len(kinds) > 1 else self._were_up
            return
        self._look_at = self._glance_at = now + EVERY_SECONDS
        if not kinds:
            # Cut off altogether: that is told as silence.
            return
        up = len(kinds) > 1
        self.missing = not up
        if up == self._were_up:
            return
        if not up:
            what = "the stream (tcp)" if "udp" in kinds else "the datagram link (udp)"
            became = "never came up" if self._were_up is None else "is dead"
            log.warning("%s %s: everything goes over %s alone", what, became, "+".join(kinds))
        elif self._were_up is not None:
            log.info("stream and datagrams are up again")
        self._were_up = up
