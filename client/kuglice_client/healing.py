"""What the stream did not bring, or what went wrong, is asked for: one question at a time, no waiting.

Where much is missing there is a second one, for a state, beside that for the ticks: these come first and are stepped
through meanwhile, and the state is taken if it is still ahead when it comes. Nobody knows beforehand which of the two
is quicker: it depends on what else this machine does, and on what is lost on the way.
"""

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

    A snapshot beside the ticks where it may come sooner than they are stepped through: one takes `state_seconds` to
    come.
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
        self._asked_into_the_void = False
        """In silence, and not over a link that is new."""
        self._overtaking: Asked | None = None
        """The state that may come before the ticks that are missing are stepped through."""
        self.brought: History | None = None
        """What the last turn got from the history."""
        self.gaps_skipped = 0
        self.silences = 0

    @property
    def asking(self) -> bool:
        """Whether an answer is waited for."""
        return self._asked is not None or self._overtaking is not None

    def turn(self, now: float, *, missing: float, step_seconds: float, silent: bool = False) -> bool:
        """Hear what was answered, ask what is needed. Whether the confirmed world is another now: the server's.

        `silent`: nothing has come for so long that the stream may have stopped while the server goes on. `missing`:
        ticks that the server has made since what is confirmed, about; one takes `step_seconds` here.
        """
        self.brought = None
        renewed, self._session = self._link.session is not self._session, self._link.session
        self._link_is_new = silent and (renewed or self._link_is_new)
        if renewed:
            self._overtaking = None
        if self._asked is not None and (renewed or (self._asked_into_the_void and not silent)):
            # The link is back: what was asked into the void is not waited for.
            self._asked, self._not_before = None, now
        replaced = self._hear_overtaking()
        if self._asked is not None:
            return self._hear(now) or replaced
        if now >= self._not_before:
            far = missing * step_seconds > max(LEAP_SECONDS, self._state_seconds)
            self._ask(silent=silent, far=far)
        return replaced

    def _ask(self, *, silent: bool, far: bool) -> None:
        gap = self._follower.gap
        self._asked_in_silence = self._asked_into_the_void = False
        leaping = far and self._overtaking is None and (gap is not None or self._link_is_new)
        if self._snapshot_needed:
            if self._overtaking is None:
                self._asked = self._ask_state(at=None)
        elif self._reconciler.wrong_since is not None and not leaping:
            # From before it went wrong: run on from there, it shows what differed first.
            self._asked = self._ask_state(at=self._reconciler.wrong_since)
        elif gap is not None:
            first, end = gap
            # All holes at once: on a long way every question costs a round trip.
            end = max(end, min(self._follower.holes_end, first + TICKS_IN_SILENCE))
            self._asked = self._ask_ticks(first, end, timeout=TIMEOUT_SECONDS)
        elif silent:
            self._asked_in_silence, self._asked_into_the_void = True, not self._link_is_new
            self.silences += 1
            first = self._follower.world.tick
            self._asked = self._ask_ticks(first, first + TICKS_IN_SILENCE, timeout=SILENT_TIMEOUT_SECONDS)
        if leaping and not self._snapshot_needed:
            # After the ticks: over one stream they would wait behind it.
            self._overtaking = self._ask_state(at=None)
        self._link_is_new = False

    def _ask_ticks(self, first: int, end: int, *, timeout: float) -> Asked:
        return self._link.ask(
            self._keys.history, TickRange(epoch=self._epoch, first=first, end=end), timeout=timeout
        )

    def _ask_state(self, *, at: int | None) -> Asked:
        return self._link.ask(
            self._keys.history,
            SnapshotRequest(epoch=self._epoch, at=at),
            timeout=max(TIMEOUT_SECONDS, PATIENT_TRIPS * self._state_seconds),
        )

    def _hear_overtaking(self) -> bool:
        """Take the state that was asked for beside the ticks, if it is still ahead of them. Whether it was taken."""
        if self._overtaking is None:
            return False
        try:
            whole = self._overtaking.poll_whole()
        except (JoinError, ProtocolError) as error:
            log.debug("%s", error)
            self._overtaking = None
            return False
        if whole is None:
            return False
        self._overtaking = None
        if whole.tick <= self._follower.world.tick:
            return False
        self._snapshot_needed = False
        self.gaps_skipped += 1
        self._reconciler.stranded(whole)
        return True

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
        if self._follower.gap is not None and whole.tick > self._follower.world.tick:
            self.gaps_skipped += 1
            self._reconciler.stranded(whole)
            return True
        return self._reconciler.received(whole)
