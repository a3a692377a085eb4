"""The chart of distance: games and views are played, not made up, and each curve is named."""

from __future__ import annotations

import pytest

from kuglice.lab.figures.look import look
from kuglice.lab.jobs import Effort
from kuglice.lab.network_cost import draw, jobs

QUICK = Effort(quick=True)


@pytest.fixture(scope="module")
def measured():
    left_out: list[str] = []
    chosen = [
        job for job in jobs(QUICK, left_out) if "gas" in job.label or job.label == "arena, one acts at 0 ms"
    ]
    rows = [row for job in chosen for row in job.measure()]
    assert left_out == []
    return rows


def test_each_game_and_each_view_is_one_job():
    labels = [job.label for job in jobs(QUICK, [])]
    assert len(labels) == len(set(labels)) == 8


def test_views_that_are_told_more_often_take_more_and_predict_better(measured):
    seldom, often = (row for row in measured if row["varied"] == "region_rate")
    assert (seldom["region_rate"], often["region_rate"]) == (2.0, 20.0)
    # Per tick: on a busy machine the two may have been served at other rates.
    often_bytes, seldom_bytes = (
        row["view_bytes_per_second"] / row["ticks_per_second"] for row in (often, seldom)
    )
    assert often_bytes > 5 * seldom_bytes
    assert often["prediction_error_mean_radii"] < seldom["prediction_error_mean_radii"]


def test_a_game_has_what_is_seen_and_what_it_takes(measured):
    (game,) = (row for row in measured if row["varied"] == "round_trip")
    assert game["hashes_equal"] == 1
    assert 0 < game["payload_up"] < game["payload_down"]
    assert 0 <= game["visible_mean_radii"] <= game["visible_worst_radii"]


def test_every_curve_has_its_name_and_what_was_not_measured_has_none(measured):
    with look():
        figure = draw(measured)
        figure.canvas.draw()
    written = {text.get_text() for axes in figure.axes for text in axes.texts}
    assert written == {
        "one acts, mean",
        "one acts, worst",
        "one acts, down",
        "one acts, up",
        "gas, mean",
        "gas, p99",
        "gas",
    }
