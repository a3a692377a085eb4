"""What the stream did not bring, or what went wrong, is asked for: one question at a time, no waiting."""

from __future__ import annotations

import logging

from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import History, Keys, SnapshotRequest, TickRange, Whole, decode
from kuglice_client.follow import Follower
from kuglice_client.link import Asked, Link
from kuglice_client.reconcile import Reconciler

__all__ = ["Healing"]

log = logging.getLogger(__name__)

TICKS_AGAIN_SECONDS = 0.05
SNAPSHOT_AGAIN_SECONDS = 0.5
TIMEOUT_SECONDS = 5.0
SILENT_TIMEOUT_SECONDS = 1.0
PATIENT_TRIPS = 4.0
"""Times what a state took to come when this client joined, for which the next is waited for at least."""
LEAP_SECONDS = 0.5
"""Of stepping, at least, to leave ticks out for a snapshot: what is stepped through is compared with the server's."""
TICKS_IN_SILENCE = 600
"""Asked for at once where the stream brings nothing: an answer has what there is of them."""


class Healing:
    """Fills gaps from the server's history, and takes a snapshot where that does not reach or bits differ.

    A snapshot too where it comes sooner than what is missing is stepped through: one takes `state_seconds` to come.
    """

    def __init__(
        self,
        link: Link,
        keys: Keys,
        *,
        epoch: int,
        follower: Follower,
        reconciler: Reconciler,
        state_seconds: float,
    ) -> None:
        self._link = link
        self._keys = keys
        self._epoch = epoch
        self._follower = follower
        self._reconciler = reconciler
        self._state_seconds = state_seconds
        self._session = link.session
        self._link_is_new = False
        self._asked: Asked | None = None
        self._snapshot_needed = False
        self._not_before = 0.0
        self._asked_in_silence = False
        self._leaping = False
        self.brought: History | None = None
        """What the last turn got from the history."""
        self.gaps_skipped = 0
        self.silences = 0

    def turn(self, now: float, *, missing: float, step_seconds: float, silent: bool = False) -> bool:
        """Hear what was answered, ask what is needed. Whether the confirmed world is another now: the server's.

        `silent`: nothing has come for so long that the stream may have stopped while the server goes on. `missing`:
        ticks that the server has made since what is confirmed, about; one takes `step_seconds` here.
        """
        self.brought = None
        renewed, self._session = self._link.session is not self._session, self._link.session
        self._link_is_new = silent and (renewed or self._link_is_new)
        if self._asked is not None and (renewed or (self._asked_in_silence and not silent)):
            # The link is back: what was asked into the void is not waited for.
            self._asked, self._not_before = None, now
        if self._asked is not None:
            return self._hear(now)
        if now >= self._not_before:
            far = missing * step_seconds > max(LEAP_SECONDS, self._state_seconds)
            self._ask(silent=silent, far=far)
        return False

    def _ask(self, *, silent: bool, far: bool) -> None:
        gap = self._follower.gap
        self._asked_in_silence = False
        self._leaping = far and (gap is not None or self._link_is_new)
        if self._snapshot_needed or self._leaping:
            request: SnapshotRequest | TickRange = SnapshotRequest(epoch=self._epoch, at=None)
        elif self._reconciler.wrong_since is not None:
            # From before it went wrong: run on from there, it shows what differed first.
            request = SnapshotRequest(epoch=self._epoch, at=self._reconciler.wrong_since)
        elif gap is not None:
            request = TickRange(epoch=self._epoch, first=gap[0], end=gap[1])
        elif silent:
            self._asked_in_silence = True
            self.silences += 1
            first = self._follower.world.tick
            request = TickRange(epoch=self._epoch, first=first, end=first + TICKS_IN_SILENCE)
        else:
            return
        timeout = SILENT_TIMEOUT_SECONDS if self._asked_in_silence else TIMEOUT_SECONDS
        if isinstance(request, SnapshotRequest):
            timeout = max(timeout, PATIENT_TRIPS * self._state_seconds)
        self._asked = self._link.ask(self._keys.history, request, timeout=timeout)

    def _hear(self, now: float) -> bool:
        asked = self._asked
        assert asked is not None
        try:
            whole = asked.poll_whole()
            if whole is None:
                return False
            self._asked = None
            if whole.of == "snapshot":
                self._snapshot_needed = False
                self._not_before = now + SNAPSHOT_AGAIN_SECONDS
                return self._take(whole)
            self._not_before = now + TICKS_AGAIN_SECONDS
            self.brought = decode(whole.data, History)
            self._follower.take(self.brought, from_history=True)
        except (JoinError, ProtocolError) as error:
            log.debug("%s", error)
            # Ticks that the server has no more can only be skipped; a server that is away is asked again.
            # One who asks in silence is told no where there is nothing new.
            refused = asked.refused and not self._asked_in_silence
            self._snapshot_needed = self._snapshot_needed or refused
            self._asked = None
            self._not_before = now + TICKS_AGAIN_SECONDS
            return False
        # As above: what the history does not reach back to can only be skipped.
        self._snapshot_needed = self._follower.gap is not None
        return False

    def _take(self, whole: Whole) -> bool:
        if (self._leaping or self._follower.gap is not None) and whole.tick > self._follower.world.tick:
            self.gaps_skipped += 1
            self._reconciler.stranded(whole)
            return True
        return self._reconciler.received(whole)
