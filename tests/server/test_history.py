"""What is asked of the past is answered as far as it is kept, and never wrongly."""

from __future__ import annotations

import threading

from hypothesis import given
from hypothesis import strategies as st

from kuglice.protocol import StretchedTick
from kuglice_server.history import BYTES_PER_TICK, FRESH_TICKS, History, KeptSnapshot


def filled(ticks: int, span: int) -> History:
    history = History(span=span)
    for tick in range(ticks):
        history.add_tick(StretchedTick(tick, b"%d" % tick, tick))
    return history


@given(st.integers(0, 60), st.integers(1, 40), st.integers(0, 80), st.integers(1, 80))
def test_a_range_is_answered_as_far_as_it_is_kept(ticks, span, first, length):
    known = range(max(0, ticks - span), ticks)
    answer = filled(ticks, span).ticks(first, first + length)
    assert [entry.tick for entry in answer] == [
        tick for tick in range(first, first + length) if tick in known
    ]
    assert all(entry.inputs == b"%d" % entry.tick for entry in answer)


@given(st.integers(0, 30), st.integers(1, 20), st.integers(1, 40))
def test_recent_is_the_end_of_what_is_kept(ticks, span, count):
    recent = filled(ticks, span).recent(count)
    assert [entry.tick for entry in recent] == list(range(max(0, ticks - span, ticks - count), ticks))


def test_the_newest_snapshot_at_or_before_a_tick():
    history = filled(100, 1000)
    for tick in (0, 30, 60, 90):
        history.add_snapshot(KeptSnapshot(tick, b"x"))
    asked = {99: 90, 90: 90, 89: 60, 59: 30, 0: 0}
    assert {at: history.snapshot(at).tick for at in asked} == asked


def test_a_snapshot_that_no_kept_tick_continues_is_forgotten():
    history = filled(100, 50)
    history.add_snapshot(KeptSnapshot(10, b"x"))
    history.add_snapshot(KeptSnapshot(60, b"x"))
    assert history.snapshot(59) is None
    assert history.snapshot(60).tick == 60


def test_snapshots_are_bounded_in_bytes_but_the_newest_always_stays():
    history = History(span=1000, snapshot_bytes=250)
    for tick in range(5):
        history.add_snapshot(KeptSnapshot(tick, bytes(100)))
    assert history.snapshot(2) is None
    assert history.snapshot(9).tick == 4
    history.add_snapshot(KeptSnapshot(5, bytes(1000)))
    assert history.snapshot(4) is None
    assert history.snapshot(9).tick == 5


def asked(history: History) -> tuple[threading.Thread, list[KeptSnapshot | None]]:
    """Somebody who asks for the state of now, and what was told."""
    told: list[KeptSnapshot | None] = []
    asking = threading.Thread(target=lambda: told.append(history.fresh_snapshot()))
    asking.start()
    return asking, told


def test_the_state_of_now_is_made_for_who_asks(monkeypatch):
    # On a busy machine a quarter of a second may pass between two lines.
    monkeypatch.setattr("kuglice_server.history.FRESH_SECONDS", 30.0)
    history = filled(100, 1000)
    history.add_snapshot(KeptSnapshot(60, b"x"))
    assert not history.wants_fresh()
    asking, told = asked(history)
    while not history.wants_fresh():
        assert asking.is_alive()
    assert not history.wants_fresh(), "asked once, made once"
    history.add_fresh(KeptSnapshot(100, b"new"))
    asking.join()
    assert told == [KeptSnapshot(100, b"new")]
    assert history.snapshot(100).tick == 60, "nor is it kept beside the others"


def test_a_state_that_is_almost_of_now_will_do():
    history = filled(60 + FRESH_TICKS, 1000)
    history.add_snapshot(KeptSnapshot(60, b"x"))
    assert history.fresh_snapshot() == KeptSnapshot(60, b"x")
    assert not history.wants_fresh()


def test_large_states_are_not_made_again_at_every_question():
    large = KeptSnapshot(60, bytes(50 * BYTES_PER_TICK))
    history = filled(60 + 50, 1000)
    history.add_snapshot(large)
    assert history.fresh_snapshot() is large
    assert not history.wants_fresh()


def test_where_none_is_made_the_newest_kept_is_told():
    history = filled(100, 1000)
    history.add_snapshot(KeptSnapshot(30, b"x"))
    assert history.fresh_snapshot() == KeptSnapshot(30, b"x")
    assert History(span=10).fresh_snapshot() is None
