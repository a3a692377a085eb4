"""Clients and views run in one loop: turns, the frames that are due, an end."""

from __future__ import annotations

import threading

from kuglice_client.run_loop import FRAME_RATE, Frames, run_loop


def test_a_screen_draws_a_frame_when_it_is_due_and_leaves_out_what_it_has_no_time_for():
    frames = Frames(None)
    step = 1 / FRAME_RATE
    assert [frames.due(at * step) for at in (0, 0.1, 0.5, 1.1, 1.2, 9.5, 9.6)] == [0, 1, 0, 1, 0, 1, 0]


def test_a_film_has_all_of_its_frames():
    frames = Frames(10.0)
    assert [frames.due(at) for at in (0.0, 0.01, 0.11, 0.95, 0.96)] == [0, 1, 1, 8, 0]


def test_every_frame_that_is_due_is_drawn_with_what_the_turn_before_it_gave():
    turns, drawn = [], []

    def turn(now: float) -> float:
        turns.append(now)
        return float(len(turns))

    run_loop(turn, drawn.append, Frames(50.0), stop=threading.Event(), seconds=0.1)
    assert len(drawn) == 5
    assert drawn == sorted(drawn)
    assert set(drawn) <= set(range(1, len(turns) + 1))


def test_a_loop_that_is_told_to_stop_ends_after_the_turn_it_is_in():
    stop, turns = threading.Event(), []

    def turn(now: float) -> float:
        turns.append(now)
        if len(turns) == 3:
            stop.set()
        return 0.0

    run_loop(turn, lambda _: None, Frames(None), stop=stop, seconds=None)
    assert len(turns) == 3
