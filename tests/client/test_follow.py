"""The confirmed world steps through the stream in order, whatever order the stream comes in."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kuglice.inputs import Kick, Thrust
from kuglice_client.follow import Follower


def played(authority, ticks: int) -> list:
    for number in range(ticks):
        inputs = [Thrust(client=1, sequence=number, x=10.0, y=number % 7)] if number % 3 == 0 else []
        inputs += [Kick(client=2, sequence=number, vx=0.1, vy=0.0)] if number % 5 == 0 else []
        authority.step(inputs)
    return authority.ticks


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.randoms(use_true_random=False), st.integers(1, 6))
def test_any_order_and_any_repetition_gives_the_same_states(authority, shuffler, repeat):
    begin = authority.world.clone()
    first = len(authority.ticks)
    played(authority, 20)
    messages = [authority.message(end, repeat) for end in range(first + 1, len(authority.ticks) + 1)]
    messages += shuffler.sample(messages, 5)
    shuffler.shuffle(messages)
    follower = Follower(begin)
    hashes = {}
    for message in messages:
        follower.take(message)
        hashes.update(
            {step.entry.tick: (step.state_hash, step.entry.state_hash) for step in follower.advance()}
        )
    assert list(hashes) == [entry.tick for entry in authority.ticks[first:]]
    told = {tick: pair for tick, pair in hashes.items() if pair[1] is not None}
    assert all(ours == theirs for ours, theirs in told.values())
    # The newest tick of a message has its hash, and every tick was the newest of one.
    assert repeat > 1 or list(told) == list(hashes)
    assert max(hashes) in told
    assert follower.world.snapshot() == authority.world.snapshot()


@pytest.mark.parametrize("lost", [1, 5, 6, 12])
def test_repeats_bridge_what_they_can_and_the_rest_is_a_gap(authority, lost):
    follower = Follower(authority.world.clone())
    authority.step()
    follower.take(authority.message(repeat=6))
    assert len(list(follower.advance())) == 1
    reached = follower.world.tick
    played(authority, lost + 1)
    follower.take(authority.message(repeat=6))
    stepped = len(list(follower.advance()))
    assert follower.missed_messages == lost
    if lost <= 5:
        assert (stepped, follower.gap) == (lost + 1, None)
        assert follower.healed_by_repeats == lost
    else:
        assert (stepped, follower.gap) == (0, (reached, reached + lost + 1 - 6))
        follower.take(authority.history(*follower.gap), from_history=True)
        assert len(list(follower.advance())) == lost + 1
        assert follower.healed_by_history == lost - 5
    assert follower.world.snapshot() == authority.world.snapshot()


def test_a_hash_that_comes_after_a_repeat_of_its_tick_is_still_checked(authority):
    follower = Follower(authority.world.clone())
    authority.step()
    first = authority.message()
    authority.step()
    follower.take(authority.message(repeat=2))
    follower.take(first)
    steps = list(follower.advance())
    assert [step.entry.state_hash for step in steps] == [entry.state_hash for entry in authority.ticks[-2:]]
    assert all(step.state_hash == step.entry.state_hash for step in steps)


def test_a_tick_whose_hash_is_not_told_is_stepped_and_not_hashed(authority):
    follower = Follower(authority.world.clone())
    authority.step()
    follower.take(authority.message().model_copy(update={"state_hash": None}))
    (step,) = follower.advance()
    assert step.state_hash is None
    assert follower.world.snapshot() == authority.world.snapshot()


def test_an_older_state_is_brought_up_to_where_it_was(authority):
    follower = Follower(authority.world.clone())
    older = None
    for _ in range(20):
        authority.step([Thrust(client=1, sequence=9, x=20, y=5)])
        follower.take(authority.message())
        assert len(list(follower.advance())) == 1
        if authority.world.tick == 12:
            older = authority.world.clone()
    follower.replace(older)
    assert len(list(follower.advance())) == 10
    assert follower.world.snapshot() == authority.world.snapshot()


def test_a_newer_state_drops_what_is_behind_it(authority):
    follower = Follower(authority.world.clone())
    authority.step()
    played(authority, 30)
    follower.take(authority.message(repeat=3))
    assert follower.gap is not None
    follower.replace(authority.world.clone())
    assert follower.gap is None
    authority.step()
    follower.take(authority.message())
    assert [step.entry.tick for step in follower.advance()] == [authority.world.tick - 1]


def test_a_tick_that_the_step_refuses_leaves_a_gap_that_history_fills(authority):
    follower = Follower(authority.world.clone())
    authority.step()
    good = authority.message()
    follower.take(good.model_copy(update={"inputs": [b"\xff" * 69]}))
    before = follower.world.snapshot()
    assert list(follower.advance()) == []
    assert follower.world.snapshot() == before
    assert follower.unusable == 1
    authority.step()
    follower.take(authority.message())
    assert follower.gap == (good.first, good.first + 1)
    follower.take(good, from_history=True)
    assert len(list(follower.advance())) == 2
    assert follower.world.snapshot() == authority.world.snapshot()
