"""Is the confirmed world the server's? Every tick by its hash, and bit for bit where snapshots are to be checked."""

from __future__ import annotations

import logging
from collections import OrderedDict
from pathlib import Path

from kuglice import World, _core
from kuglice.errors import SnapshotError
from kuglice.protocol import Whole
from kuglice_client.desync import Desync, compare_worlds
from kuglice_client.desync_report import write_report
from kuglice_client.follow import Confirmed, Follower

__all__ = ["Reconciler"]

log = logging.getLogger(__name__)

KEPT_STATES = 4
WAITING_SNAPSHOTS = 8
LOGGED_DESYNCS = 10


class Reconciler:
    """Compares; on a mismatch takes the server's state, counts, and reports.

    `snapshot_every`: ticks between the server's snapshots, whose states are kept here for comparison; None: none come
    but those that are asked for. `reports`: a directory that gets a file per desync; `step_version` is the server's.
    """

    def __init__(
        self,
        follower: Follower,
        *,
        snapshot_every: int | None,
        reports: Path | None = None,
        step_version: int = _core.STEP_VERSION,
    ) -> None:
        self._follower = follower
        self._every = snapshot_every
        self._reports = reports
        self._step_version = step_version
        self._states: OrderedDict[int, bytes] = OrderedDict()
        self._waiting: OrderedDict[int, Whole] = OrderedDict()
        self._wrong: World | None = None
        self.hashes_checked = 0
        self.hash_mismatches = 0
        self.snapshots_checked = 0
        self.snapshot_mismatches = 0
        self.snapshots_taken = 0
        self.snapshots_too_old = 0
        self.desyncs: list[Desync] = []
        self._keep()

    @property
    def wrong_since(self) -> int | None:
        """The first tick whose state is known to differ, until a snapshot has put it right."""
        return None if self._wrong is None else self._wrong.tick

    def confirmed(self, step: Confirmed) -> None:
        """A tick was stepped: compare its hash, keep the state if a snapshot of it will come."""
        if step.entry.state_hash is not None:
            self.hashes_checked += 1
        if step.state_hash != step.entry.state_hash:
            self.hash_mismatches += 1
            if self._wrong is None:
                # Kept as it is: once the server's state is here, the two can be compared ball by ball.
                self._wrong = self._follower.world.clone()
                ours, theirs = step.state_hash, step.entry.state_hash
                log.error("state %d: hash %016x here, %016x there", self._wrong.tick, ours, theirs)
        self._keep()

    def received(self, snapshot: Whole) -> bool:
        """A snapshot from the server. Whether it replaced the confirmed world."""
        tick = snapshot.tick
        if tick > self._follower.world.tick:
            self._waiting[tick] = snapshot
            while len(self._waiting) > WAITING_SNAPSHOTS:
                self._waiting.popitem(last=False)
                self.snapshots_too_old += 1
            return False
        ours = self._states.get(tick)
        if ours is not None:
            self.snapshots_checked += 1
            self.snapshot_mismatches += ours != snapshot.data
        elif self._wrong is None:
            self.snapshots_too_old += 1
        if self._wrong is None and ours in (None, snapshot.data):
            return False
        return self._take(snapshot, ours)

    def compare_waiting(self) -> bool:
        """Compare a snapshot that was ahead of the confirmed world, once that has reached its tick."""
        snapshot = self._waiting.pop(self._follower.world.tick, None)
        return snapshot is not None and self.received(snapshot)

    def stranded(self, snapshot: Whole) -> None:
        """Take a snapshot because nothing else leads on: the gap is longer than the server's history."""
        self._take(snapshot, None)

    def _keep(self) -> None:
        world = self._follower.world
        if self._every is not None and world.tick % self._every == 0:
            self._states[world.tick] = world.snapshot()
            while len(self._states) > KEPT_STATES:
                self._states.popitem(last=False)

    def _take(self, snapshot: Whole, ours: bytes | None) -> bool:
        world = self._follower.world
        try:
            theirs = World.restore(world.scene, snapshot.data, world.model)
        except SnapshotError:
            log.exception("snapshot %d cannot be restored", snapshot.tick)
            return False
        self._report(theirs, ours)
        self.snapshots_taken += 1
        self._states.clear()
        self._waiting.clear()
        self._wrong = None
        self._follower.replace(theirs)
        self._keep()
        return True

    def _report(self, theirs: World, ours: bytes | None) -> None:
        """Compare the first wrong state, if ticks lead to it from theirs; else the two of this tick."""
        rerun = theirs.clone()
        if (
            self._wrong is not None
            and self._follower.rerun(rerun, self._wrong.tick)
            and rerun.tick == self._wrong.tick
        ):
            found = self._wrong, rerun, "hash"
        elif ours not in (None, theirs.snapshot()):
            found = World.restore(theirs.scene, ours, theirs.model), theirs, "snapshot"
        else:
            return
        if len(self.desyncs) >= LOGGED_DESYNCS:
            return
        mine, right, found_by = found
        desync = compare_worlds(mine, right, found_by=found_by)
        self.desyncs.append(desync)
        log.error("%s", desync)
        if self._reports is not None:
            write_report(
                self._reports, mine, right, found_by=found_by, theirs_step_version=self._step_version
            )
