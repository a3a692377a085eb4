"""A study says what was seen, and reading it says how far that was from the server's world."""

from __future__ import annotations

import pytest

import kuglice as kg
from kuglice.errors import ReplayError
from kuglice.inputs import pack
from kuglice.study import Study, other_screen_delays, own_screen_delays
from kuglice.study.table import by_second, summary
from shared.studied_session import ME, OTHER, RATE, Session


@pytest.fixture
def path(tmp_path):
    return tmp_path / "ana.study"


def push(client, sequence):
    return kg.Thrust(client=client, sequence=sequence, x=40.0, y=0.0)


def test_what_was_predicted_right_and_drawn_there_is_no_error(path):
    session = Session(path)
    for _ in range(10):
        session.tick()
    session.recorder.close()
    frames = list(Study.load(path).frames())
    # The last two frames show ticks that were not confirmed yet.
    assert len(frames) == 8
    assert all(frame.predicted_equal and frame.ahead == 2 for frame in frames)
    # Places are kept in single precision.
    assert max(frame.worst_error for frame in frames) < 1e-5


def test_an_error_is_the_distance_from_where_a_ball_should_have_been_in_its_radii(path):
    session = Session(path)
    for _ in range(6):
        session.tick(off=0.1)
    session.recorder.close()
    frames = list(Study.load(path).frames())
    assert [frame.worst_error for frame in frames] == pytest.approx([0.1 / 0.4] * 4, rel=1e-4)
    assert [frame.own_error for frame in frames] == pytest.approx([0.1 / 0.4] * 4, rel=1e-4)
    assert frames[0].mean_error == pytest.approx((12 * 0.1 / 0.5 + 2 * 0.1 / 0.4) / 14, rel=1e-4)


def test_a_guess_that_was_wrong_has_another_hash(path):
    session = Session(path)
    session.tick()
    session.tick()
    session.tick([push(OTHER, 2)])
    session.recorder.rollback(session.now, session.confirmed.tick, session.confirmed.tick + 2)
    for _ in range(3):
        session.tick()
    session.recorder.close()
    study = Study.load(path)
    frames = list(study.frames())
    assert [frame.predicted_equal for frame in frames] == [False, False, True, True]
    assert frames[0].worst_error > 1e-4
    figures = summary(study, frames)
    assert (figures["rollbacks"], figures["mean_rollback_ticks"], figures["predicted_equal"]) == (1, 2, 0.5)
    assert by_second(study, frames)[0]["rollbacks"] == 1


def test_the_servers_state_that_was_taken_is_what_later_frames_are_compared_with(path):
    session = Session(path)
    session.tick()
    session.confirmed.step([kg.Kick(ball=3, vx=1.0, vy=0.0)])
    session.recorder.state(session.now, session.confirmed)
    for _ in range(4):
        session.tick()
    session.recorder.close()
    assert all(frame.predicted_equal for frame in list(Study.load(path).frames())[1:])


def test_a_restart_of_the_server_begins_another_part(path):
    session = Session(path)
    for _ in range(4):
        session.tick()
    session.epoch += 1
    session.joined()
    for _ in range(4):
        session.tick()
    session.recorder.close()
    study = Study.load(path)
    assert summary(study, list(study.frames()))["joined"] == 2
    assert len(list(study.frames())) == 4


def test_own_delay_is_from_acting_to_the_first_frame_after_its_tick(path):
    session = Session(path)
    session.tick()
    session.act(push(ME, 2), session.predicted.tick)
    session.tick(known=[push(ME, 2)])
    session.act(push(ME, 3), session.predicted.tick + 1)
    session.tick([push(ME, 2)])
    session.tick()
    session.recorder.close()
    assert own_screen_delays(Study.load(path)) == pytest.approx([1 / RATE, 2 / RATE])


def test_anothers_delay_is_until_a_state_that_the_input_acted_in_is_drawn(tmp_path):
    mine, hers = Session(tmp_path / "mine"), Session(tmp_path / "hers", number=OTHER)
    hers.now += 0.5 / RATE
    mine.act(push(ME, 2), 3)
    for session in (mine, hers):
        session.tick()
        session.tick()
        session.tick([push(ME, 2)])
        session.tick()
        session.recorder.close()
    acting, looking = Study.load(tmp_path / "mine"), Study.load(tmp_path / "hers")
    assert other_screen_delays(acting, looking) == pytest.approx([3.5 / RATE])
    assert other_screen_delays(looking, acting) == [], "she has not acted"


def test_where_positions_are_too_many_only_some_frames_have_them(path):
    session = Session(path, seen_bytes=14 * 8 * RATE / 4)
    for _ in range(40):
        session.tick()
    session.recorder.close()
    study = Study.load(path)
    assert summary(study, frames := list(study.frames()))["frames"] == 40
    assert len(frames) == pytest.approx(10, abs=2)


def test_what_is_no_study_is_an_error(path):
    path.write_bytes(b"kuglice replay\n")
    with pytest.raises(ReplayError, match="not a study file"):
        Study.load(path)
    session = Session(path)
    session.tick()
    session.recorder.close()
    data = bytearray(path.read_bytes())
    data[-20] ^= 1
    path.write_bytes(data)
    with pytest.raises(ReplayError, match="damaged"):
        Study.load(path)


def test_a_study_that_was_cut_off_is_read_as_far_as_it_goes(path):
    session = Session(path)
    for _ in range(6):
        session.tick()
    session.recorder.close()
    path.write_bytes(path.read_bytes()[:-5])
    assert len(list(Study.load(path).frames())) == 4


def test_inputs_that_do_not_lead_to_the_servers_states_are_an_error(path):
    session = Session(path)
    session.tick()
    session.recorder.tick(session.now, session.confirmed.tick, pack([push(OTHER, 2)]), 12345)
    session.recorder.close()
    with pytest.raises(ReplayError, match="the server told"):
        list(Study.load(path).frames())
