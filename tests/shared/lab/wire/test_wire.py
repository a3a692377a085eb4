"""`kuglice bench wire`, its smallest scene: a real server, a listener and a view."""

from __future__ import annotations

from kuglice.lab.jobs import done
from kuglice.lab.wire.measure import jobs


def test_a_row_says_what_a_snapshot_a_client_and_a_view_take():
    (row,) = done(jobs(scenes=["gas:n=1000"], seconds=1.5, threads=1))
    assert row["balls"] == 1000
    # Every bit of four numbers a ball, packed: less than they take, more than their rounded likenesses.
    assert 1000 * row["bytes_per_ball_told"] < row["snapshot_bytes"] < 32 * 1000
    assert row["client_bytes_per_second"] > 0
    assert row["regions_followed"] == 16
    assert 5 < row["bytes_per_ball_told"] < 10
    assert row["view_bytes_per_second"] > row["client_bytes_per_second"]
    assert 0 < row["told_within_radii"] <= 1 / 512
    assert row["prediction_error_mean_radii"] < 0.1
