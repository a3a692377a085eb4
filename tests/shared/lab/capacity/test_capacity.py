"""`kuglice bench capacity`, its lowest rung: real listeners, directly and behind a router."""

from __future__ import annotations

from kuglice.lab.capacity.measure import jobs
from kuglice.lab.jobs import done


def test_every_listener_hears_every_tick_and_costs_the_server_nothing_behind_a_router():
    direct, passed_on = done(jobs(routers=(0, 1), ladder=(4,), seconds=1.0, kinds=("client",)))
    for row in (direct, passed_on):
        assert row["listeners"] == 4
        assert row["tick_rate"] > 30
        assert row["missed_permille"] == 0
        assert row["bytes_per_second"] > 1000
    assert direct["routers_percent"] == 0


def test_views_hear_every_message_of_their_regions():
    (row,) = done(jobs(routers=(0,), ladder=(4,), seconds=1.0, kinds=("view",)))
    assert (row["listeners"], row["players"]) == (4, 0)
    assert row["missed_permille"] == 0
    # 16 regions of 40 balls, ten times per second.
    assert row["bytes_per_second"] > 10_000
