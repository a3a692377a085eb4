"""What the server tells everybody: ticks, snapshots where they are wanted; and when nothing comes."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator

from kuglice.errors import ProtocolError
from kuglice.protocol import PART_BYTES, Assembly, Tick, Whole
from kuglice_client.credibility import Credibility
from kuglice_client.join import Joined
from kuglice_client.link import Link
from kuglice_client.totals import Totals

__all__ = ["Stream"]

log = logging.getLogger(__name__)

STALL_SECONDS = 2.0
SILENCE_SECONDS = 0.5
SILENCE_TICKS = 4
SNAPSHOT_BYTES_PER_BALL = 64


class Stream:
    """Of the run of the server that was joined at `now`. What `lose` says True for is thrown away on arrival."""

    def __init__(
        self,
        link: Link,
        joined: Joined,
        credibility: Credibility,
        *,
        lose: Callable[[int], bool] | None,
        totals: Totals,
        now: float,
    ) -> None:
        self._link = link
        self._world = joined.about.world
        self._epoch = joined.epoch
        self._credibility = credibility
        self._lose = lose
        self._totals = totals
        self._assembly = Assembly()
        self.silence_seconds = max(SILENCE_SECONDS, SILENCE_TICKS / joined.about.rate)
        """More than a server that keeps its rate is ever silent for."""
        self._stalled = False
        self.heard_at = now
        """When the last tick of this run came."""
        # The ring must hold a whole snapshot and the begin of the next, also when there will be more balls.
        balls = max(joined.world.count, joined.scene.limits.max_balls)
        link.make_room(3 * (SNAPSHOT_BYTES_PER_BALL * balls // PART_BYTES + 1))

    def silent(self, now: float) -> bool:
        """Whether nothing has come for so long that the stream may have stopped while the server goes on."""
        return now - self.heard_at > self.silence_seconds

    def snapshots(self) -> Iterator[Whole]:
        """Whole snapshots of this run that came since the last call."""
        for part in self._link.snapshot_parts():
            try:
                whole = self._assembly.add(part) if part.epoch == self._epoch else None
            except ProtocolError as error:
                self._totals.malformed_snapshots += 1
                log.warning("%s", error)
                continue
            if whole is not None:
                yield whole

    def ticks(self, now: float) -> Iterator[Tick]:
        """Messages of this run that came since the last call, as far as they are to be believed."""
        for message in self._link.ticks():
            if not self._credibility.believes(message, now):
                continue
            if self._lose is not None and self._lose(message.end - 1):
                self._totals.messages_thrown_away += 1
            else:
                self.heard_at, self._stalled = now, False
                yield message
        if now - self.heard_at > STALL_SECONDS and not self._stalled:
            self._stalled = True
            log.warning("no news of world %s for %g s", self._world, STALL_SECONDS)
