"""Equal is told from different, one bit apart; what is different is reported and replaced."""

from __future__ import annotations

import pytest

from kuglice import World
from kuglice.inputs import Kick, pack
from kuglice.protocol import Whole
from kuglice_client.follow import Follower
from kuglice_client.reconcile import KEPT_STATES, Reconciler

EVERY = 10


class Pair:
    """An authority and one who follows it, tick by tick."""

    def __init__(self, authority) -> None:
        self.authority = authority
        self.follower = Follower(authority.world.clone())
        self.reconciler = Reconciler(self.follower, snapshot_every=EVERY)
        self.snapshots: dict[int, Whole] = {}

    def run(self, ticks: int) -> None:
        for _ in range(ticks):
            world = self.authority.world
            if world.tick % EVERY == 0:
                self.snapshots[world.tick] = Whole("snapshot", 5, world.tick, world.snapshot())
            self.authority.step([Kick(client=1, sequence=world.tick, vx=0.5, vy=0.25)])
            self.follower.take(self.authority.message())
            for step in self.follower.advance():
                self.reconciler.confirmed(step)

    def go_wrong(self) -> None:
        """One tick more, in which a velocity gets the smallest change there is, in this world only."""
        changed = self.follower.world.clone()
        self.run(1)
        changed.step(self.authority.ticks[-1].inputs + pack([Kick(ball=3, vx=2.0**-50, vy=0.0)]))
        assert changed.tick == self.follower.world.tick
        assert changed.state_hash != self.authority.world.state_hash
        self.follower.replace(changed)


@pytest.fixture
def pair(authority):
    return Pair(authority)


def test_a_world_that_follows_is_equal_at_every_tick_and_in_every_snapshot(pair):
    pair.run(50)
    for snapshot in list(pair.snapshots.values())[-KEPT_STATES:]:
        assert not pair.reconciler.received(snapshot)
    assert pair.reconciler.hashes_checked == 50
    assert pair.reconciler.hash_mismatches == 0
    assert pair.reconciler.snapshots_checked == KEPT_STATES
    assert pair.reconciler.snapshot_mismatches == 0
    assert pair.reconciler.desyncs == []


def test_a_bit_that_differs_is_seen_by_the_next_hash(pair):
    pair.run(12)
    pair.go_wrong()
    assert pair.reconciler.wrong_since is None
    pair.run(1)
    assert pair.reconciler.hash_mismatches == 1
    assert pair.reconciler.wrong_since == pair.follower.world.tick


@pytest.mark.parametrize("tick", [10, 20])
def test_a_snapshot_puts_it_right_and_the_report_names_tick_and_balls(pair, tick):
    """One from before it went wrong leads to the very first wrong state, in which one ball differs."""
    pair.run(12)
    pair.go_wrong()
    pair.run(15)
    wrong_since = pair.reconciler.wrong_since
    assert wrong_since == 16
    assert pair.reconciler.received(pair.snapshots[tick])
    assert pair.reconciler.wrong_since is None
    (desync,) = pair.reconciler.desyncs
    assert desync.tick == max(wrong_since, tick)
    assert any(line.startswith("ball 3:") for line in desync.balls)
    if tick < wrong_since:
        assert desync.differing == 1
    for step in pair.follower.advance():
        pair.reconciler.confirmed(step)
    assert pair.follower.world.snapshot() == pair.authority.world.snapshot()


def test_a_snapshot_that_is_ahead_waits_for_its_tick(pair):
    pair.run(5)
    ahead = pair.authority.world.clone()
    while ahead.tick % EVERY:
        ahead.step([Kick(client=1, sequence=ahead.tick, vx=0.5, vy=0.25)])
    assert not pair.reconciler.received(Whole("snapshot", 5, ahead.tick, ahead.snapshot()))
    assert not pair.reconciler.compare_waiting()
    assert pair.reconciler.snapshots_checked == 0
    pair.run(ahead.tick - pair.authority.world.tick)
    assert not pair.reconciler.compare_waiting()
    assert (pair.reconciler.snapshots_checked, pair.reconciler.snapshot_mismatches) == (1, 0)


def test_a_snapshot_that_differs_where_no_hash_did_is_taken(pair):
    """The state is believed, not its hash: a server that hashes wrongly must not go unnoticed."""
    pair.run(25)
    other = World.restore(pair.authority.world.scene, pair.snapshots[20].data, pair.authority.world.model)
    other.step([Kick(ball=1, vx=1.0, vy=0.0)])
    while other.tick % EVERY:
        other.step()
    pair.run(other.tick - pair.follower.world.tick)
    assert pair.reconciler.received(Whole("snapshot", 5, other.tick, other.snapshot()))
    assert (pair.reconciler.snapshot_mismatches, pair.reconciler.snapshots_taken) == (1, 1)
    assert pair.follower.world.snapshot() == other.snapshot()


def test_a_snapshot_older_than_what_is_kept_is_counted_not_compared(pair):
    pair.run(EVERY * (KEPT_STATES + 3))
    assert not pair.reconciler.received(pair.snapshots[10])
    assert (pair.reconciler.snapshots_too_old, pair.reconciler.snapshots_checked) == (1, 0)


def test_a_snapshot_that_cannot_be_restored_changes_nothing(pair):
    pair.run(25)
    before = pair.follower.world.snapshot()
    assert not pair.reconciler.received(Whole("snapshot", 5, 20, b"nonsense"))
    assert pair.follower.world.snapshot() == before


def test_snapshots_that_come_long_before_their_ticks_are_all_compared(pair):
    """A client that was away finds all of them at once, before it has stepped to any of them."""
    world, ahead = pair.authority.world, []
    for _ in range(35):
        if world.tick % EVERY == 0:
            ahead.append(Whole("snapshot", 5, world.tick, world.snapshot()))
        pair.authority.step()
        pair.follower.take(pair.authority.message())
    assert len(ahead) == 3
    for snapshot in ahead:
        assert not pair.reconciler.received(snapshot)
    for step in pair.follower.advance():
        pair.reconciler.confirmed(step)
        assert not pair.reconciler.compare_waiting()
    assert (pair.reconciler.snapshots_checked, pair.reconciler.snapshot_mismatches) == (3, 0)


def test_without_published_snapshots_none_of_ones_own_are_kept(authority):
    """One that was asked for, from before the first wrong state, shows what differed all the same."""
    pair = Pair(authority)
    pair.reconciler = Reconciler(pair.follower, snapshot_every=None)
    pair.run(12)
    pair.go_wrong()
    pair.run(15)
    assert pair.reconciler.wrong_since == 16
    assert pair.reconciler.received(pair.snapshots[10])
    (desync,) = pair.reconciler.desyncs
    assert (desync.tick, desync.differing, desync.found_by) == (16, 1, "hash")
    assert pair.reconciler.snapshots_checked == 0
