"""What is asked of the past is answered as far as it is kept, and never wrongly."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from kuglice.protocol import StretchedTick
from kuglice_server.history import History, KeptSnapshot


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
    asked = {None: 90, 90: 90, 89: 60, 59: 30, 0: 0}
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
    assert history.snapshot(None).tick == 4
    history.add_snapshot(KeptSnapshot(5, bytes(1000)))
    assert history.snapshot(4) is None
    assert history.snapshot(None).tick == 5
