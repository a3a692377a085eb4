"""The absolute schedule, on a clock that only moves when the test or a sleep moves it."""

from __future__ import annotations

import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice_server.schedule import Schedule


class Clock(threading.Event):
    """A clock, and an event whose waiting moves it."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 100.0

    def __call__(self) -> float:
        return self.now

    def wait(self, timeout: float | None = None) -> bool:
        assert timeout is not None
        assert timeout > 0
        self.now += timeout
        return False


@given(st.lists(st.floats(0.0, 0.02), min_size=1, max_size=200))
def test_lateness_within_patience_does_not_add_up(work):
    clock = Clock()
    schedule = Schedule(100.0, patience=1e9, clock=clock)
    for seconds in work:
        schedule.wait(clock)
        clock.now += seconds
    assert schedule.due == pytest.approx(100.0 + len(work) / 100.0)
    assert schedule.seconds_lost == 0


def test_a_late_tick_is_caught_up_by_ticks_that_do_not_wait():
    clock = Clock()
    schedule = Schedule(10.0, patience=1.0, clock=clock)
    schedule.wait(clock)
    clock.now += 0.45
    lateness = [schedule.wait(clock) for _ in range(5)]
    assert lateness == pytest.approx([0.35, 0.25, 0.15, 0.05, 0.0])
    assert clock.now == pytest.approx(100.5)
    assert schedule.late_ticks == 3
    assert schedule.worst_lateness == pytest.approx(0.35)


def test_a_long_stall_is_given_up_and_counted():
    clock = Clock()
    schedule = Schedule(10.0, patience=0.25, clock=clock)
    schedule.wait(clock)
    clock.now += 60.0
    assert schedule.wait(clock) == pytest.approx(59.9)
    assert schedule.seconds_lost == pytest.approx(59.9)
    assert schedule.wait(clock) == pytest.approx(0.0)
    assert clock.now == pytest.approx(160.1)


@given(st.lists(st.floats(0.0, 3.0), min_size=1, max_size=60))
def test_no_second_goes_missing(work):
    """Time that passed = ticks at their rate, what was given up, and what the schedule is behind or ahead."""
    clock = Clock()
    schedule = Schedule(10.0, clock=clock)
    for seconds in work:
        schedule.wait(clock)
        clock.now += seconds
    behind = clock.now - schedule.due
    assert clock.now - 100.0 == pytest.approx(len(work) / 10.0 + schedule.seconds_lost + behind)
    assert behind <= max(work) + 0.25


def test_stopping_ends_the_wait():
    stop = threading.Event()
    stop.set()
    schedule = Schedule(0.001)
    schedule.wait(stop)
    schedule.wait(stop)
