"""Who cannot step fast enough is told on joining, and told what to do instead."""

from __future__ import annotations

import logging

import pytest

from kuglice import World, scenes
from kuglice.errors import JoinError
from kuglice_client.pace import STEPS, judge_pace, step_seconds


class Ticking:
    """A clock that goes on by the next of `steps` between the two readings around each step."""

    def __init__(self, steps):
        self._now, self._steps, self._readings = 0.0, iter(steps), 0

    def __call__(self) -> float:
        # One reading at the start; then one before a step, and two after it.
        if self._readings % 3 == 2:
            self._now += next(self._steps)
        self._readings += 1
        return self._now


def test_the_fastest_of_a_few_steps_counts_and_the_world_stays_where_it_is():
    world = World(scenes.gas(n=50))
    took = [0.02, 0.011, 0.013, 0.011, 0.012, 0.02, 0.02, 0.02]
    assert len(took) == STEPS
    assert step_seconds(world, Ticking(took)) == pytest.approx(0.011)
    assert world.tick == 0


def test_a_slow_step_is_measured_no_longer_than_it_takes_to_know():
    assert step_seconds(World(scenes.gas(n=50)), Ticking([0.5])) == pytest.approx(0.5)


def test_twice_real_time_is_enough(caplog):
    judge_pace(0.5 / 60, rate=60, balls=100)
    judge_pace(0.0, rate=60, balls=0)
    assert not caplog.records


def test_less_than_twice_real_time_is_warned_of(caplog):
    with caplog.at_level(logging.WARNING):
        judge_pace(0.010, rate=60, balls=50_000)
    (record,) = caplog.records
    assert "50000 balls takes 10 ms" in record.message
    assert "1.7 times real time, at least 2" in record.message
    assert "kuglice view" in record.message


def test_slower_than_real_time_cannot_follow():
    with pytest.raises(
        JoinError, match=r"0\.6 times real time, at least 1 needed to follow: .*`kuglice view`"
    ):
        judge_pace(1 / 36, rate=60, balls=1_000_000)
