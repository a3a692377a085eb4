"""`kuglice bench capacity`, its lowest rung: real listeners, directly and behind a router."""

from __future__ import annotations

from kuglice.lab.capacity.measure import jobs
from kuglice.lab.jobs import Job, done
from kuglice.lab.rows import Rows

MEASUREMENTS = 5
"""At most. What is best-effort may be lost on a busy machine, and a tick be late: then it is measured again."""


def heard_by_all(kind: str, *, routers: tuple[int, ...]) -> Rows:
    """A row for each number of routers."""
    every = jobs(routers=routers, ladder=(4,), seconds=1.0, kinds=(kind,))
    return [row for job in every for row in _whole(job)]


def _whole(job: Job) -> Rows:
    for _ in range(MEASUREMENTS - 1):
        rows = done([job])
        if all(row["missed_permille"] == 0 and row["tick_rate"] > 30 for row in rows):
            return rows
    return done([job])


def test_every_listener_hears_every_tick_and_costs_the_server_nothing_behind_a_router():
    direct, passed_on = heard_by_all("client", routers=(0, 1))
    for row in (direct, passed_on):
        assert row["listeners"] == 4
        assert row["tick_rate"] > 30
        assert row["missed_permille"] == 0
        assert row["bytes_per_second"] > 1000
    assert direct["routers_percent"] == 0


def test_views_hear_every_message_of_their_regions():
    (row,) = heard_by_all("view", routers=(0,))
    assert (row["listeners"], row["players"]) == (4, 0)
    assert row["missed_permille"] == 0
    # 16 regions of 40 balls, ten times per second.
    assert row["bytes_per_second"] > 10_000
