"""What is counted is what can be seen: per frame, whatever the turns in between."""

from __future__ import annotations

import numpy as np
import pytest

from kuglice.inputs import Thrust
from kuglice_client.prediction import Prediction
from kuglice_client.screen import Screen

RATE = 60.0
OTHER = 2


def confirm(prediction, confirmed, entry, in_time=lambda: True) -> None:
    confirmed.step(entry.inputs)
    prediction.confirm(entry)
    prediction.reconcile(confirmed, in_time)


def push(sequence: int) -> Thrust:
    return Thrust(client=OTHER, sequence=sequence, x=40.0, y=3.0)


@pytest.fixture
def played(authority):
    """A screen that has drawn a frame, five ticks ahead of a world that another is about to push in."""
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for _ in range(5):
        prediction.step()
    screen = Screen()
    screen.alpha = 0.5
    screen.frame(1.0, prediction)
    return screen, prediction, confirmed


def test_a_rollback_does_not_move_the_picture_at_once(authority, played):
    screen, prediction, confirmed = played
    ids, before = prediction.drawn(0.5)
    confirm(prediction, confirmed, authority.step([push(1)]))
    screen.switched(prediction.switched(confirmed), prediction, now=1.01, rate=RATE)
    same, after = prediction.drawn(0.5)
    assert (ids == same).all()
    assert np.abs(after - before).max() > 1e-6, "the state is right at once"
    assert screen.seen(ids, after) == pytest.approx(before)
    assert screen.correction.worst_jump > 0


def test_turns_between_two_frames_count_for_nothing(authority, played):
    screen, prediction, confirmed = played
    confirm(prediction, confirmed, authority.step([push(1)]))
    screen.switched(prediction.switched(confirmed), prediction, now=1.01, rate=RATE)
    counted = []
    for turns in (1, 5):
        for _ in range(turns):
            assert prediction.switched(confirmed) is None
        screen.frame(1.02, prediction)
        counted.append(screen.correction.mean)
    # Two frames at one moment show the same offsets, and the one before them none.
    assert counted[1] == pytest.approx(counted[0] * (2 / 3) / (1 / 2))


def test_a_stream_that_overtakes_a_picture_that_stood_still_is_a_jump_and_glided_over(authority, played):
    screen, prediction, confirmed = played
    ids, before = prediction.drawn(0.5)
    for _ in range(20):
        confirm(prediction, confirmed, authority.step())
    switched = prediction.switched(confirmed)
    assert switched is not None
    screen.switched(switched, prediction, now=1.0, rate=RATE)
    assert prediction.world.tick == confirmed.tick
    assert screen.correction.worst_jump > 0
    moved = screen.seen(ids, prediction.drawn(0.5)[1])
    assert moved == pytest.approx(before), "balls are where they were drawn, and glide from there"


def test_a_stream_that_overtakes_no_faster_than_time_passes_is_motion(authority, played):
    screen, prediction, confirmed = played
    for _ in range(10):
        confirm(prediction, confirmed, authority.step())
    expected = prediction.world.clone()
    switched = prediction.switched(confirmed)
    screen.switched(switched, prediction, now=1.0 + 5 / RATE, rate=RATE)
    flown = np.hypot(*(expected.position - switched[1].position).T).max()
    assert flown > 0.1
    # Balls that met something on the way are not where their velocity pointed to.
    assert np.median(np.hypot(*screen.correction.drawn(expected.id, expected.position).T)) > 0
    offsets = screen.seen(expected.id, expected.position) - expected.position
    assert np.median(np.hypot(*offsets.T)) < 0.1 * flown


def test_before_the_first_frame_nothing_has_been_seen(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for _ in range(3):
        confirm(prediction, confirmed, authority.step([push(1)]))
    screen = Screen()
    screen.switched(prediction.switched(confirmed), prediction, now=1.0, rate=RATE)
    screen.frame(1.0, prediction)
    assert (screen.correction.worst, screen.correction.worst_jump) == (0.0, 0.0)


def test_an_own_input_is_seen_in_the_frame_that_shows_the_state_after_its_tick(authority):
    prediction = Prediction(authority.world, limit=30)
    screen = Screen()
    screen.feel.acted(1, prediction.world.tick, 1.0)
    screen.frame(1.01, prediction)
    prediction.step()
    screen.frame(1.02, prediction)
    delay = screen.feel.own_input_delay()
    assert delay["mean"] == pytest.approx(20.0)
    assert delay["mean_frames"] == 2
