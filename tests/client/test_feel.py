"""Delays of own inputs and recoveries, from moments that are given here."""

from __future__ import annotations

import pytest

from kuglice_client.feel import SILENCE_SECONDS, Feel


def test_an_input_is_seen_once_by_the_first_frame_after_its_tick():
    feel = Feel()
    feel.acted(1, 10, 1.000)
    feel.acted(2, 11, 1.010)
    assert feel.shown(10, 1.005) == []
    assert feel.shown(11, 1.020) == [(1, 10)]
    assert feel.shown(12, 1.030) == [(2, 11)]
    assert feel.shown(13, 1.040) == []
    delay = feel.own_input_delay()
    assert delay["mean"] == pytest.approx(20.0)
    assert delay["p99"] == pytest.approx(20.0)
    assert (delay["mean_frames"], delay["worst_frames"]) == (2.5, 3)
    assert feel.inputs == 2


def test_one_frame_may_be_the_first_to_show_several():
    feel = Feel()
    for sequence in (1, 2, 3):
        feel.acted(sequence, 10, 1.0)
    assert feel.shown(15, 1.016) == [(1, 10), (2, 10), (3, 10)]


def test_without_inputs_there_is_no_delay():
    assert set(Feel().own_input_delay().values()) == {None}


def test_what_a_restart_of_the_server_swallowed_is_never_seen():
    feel = Feel()
    feel.acted(1, 10, 1.0)
    feel.entered()
    assert feel.shown(20, 2.0) == []
    assert feel.own_input_delay()["mean"] is None


def test_recovery_is_from_the_first_message_after_a_silence_until_all_that_was_told_is_done():
    feel = Feel()
    for at in (0.0, 0.5, 1.0):
        feel.heard(at)
        feel.caught_up(at + 0.01)
    assert feel.recovery == []
    feel.heard(5.0)
    feel.heard(5.1)
    feel.caught_up(5.2)
    feel.caught_up(5.3)
    assert feel.recovery == [pytest.approx(0.2)]
    assert feel.recovered_at == [5.2]


def test_a_pause_shorter_than_a_silence_is_none():
    feel = Feel()
    feel.heard(1.0)
    feel.heard(1.0 + 0.99 * SILENCE_SECONDS)
    feel.caught_up(9.0)
    assert feel.recovery == []
