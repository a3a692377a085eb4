"""Games over links of growing round trip, and views that are told more and more often."""

from __future__ import annotations

from functools import partial

from kuglice.errors import KugliceError
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.network.cell import Cell
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.subjects import SUBJECTS
from kuglice.lab.network.table import JITTER, LOSS
from kuglice.lab.rows import Rows
from kuglice.lab.wire.measure import measured

__all__ = ["PLAYED", "VIEWED", "jobs"]

ROUND_TRIPS = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)
QUICK_ROUND_TRIPS = (0.0, 0.15)
SECONDS, QUICK_SECONDS = 6.0, 2.0
PLAYED = ("arena", "arena, one acts")
REGION_RATES = (1.0, 2.0, 5.0, 10.0, 20.0, 60.0)
QUICK_REGION_RATES = (2.0, 20.0)
VIEWED = ("gas:n=1000", "rain:n=1000")


def jobs(effort: Effort, left_out: list[str]) -> list[Job]:
    """One per game and view."""
    games = [
        Job(f"{name} at {1000 * round_trip:g} ms", partial(_at, name, round_trip, effort, left_out))
        for name in PLAYED
        for round_trip in (QUICK_ROUND_TRIPS if effort.quick else ROUND_TRIPS)
    ]
    views = [
        Job(f"view of {scene}, told {rate:g} times per second", partial(_told, scene, rate, effort, left_out))
        for scene in VIEWED
        for rate in (QUICK_REGION_RATES if effort.quick else REGION_RATES)
    ]
    return games + views


def _at(name: str, round_trip: float, effort: Effort, left_out: list[str]) -> Rows:
    conditions = Conditions(round_trip=round_trip, jitter=JITTER if round_trip else 0.0, loss=LOSS)
    seconds = QUICK_SECONDS if effort.quick else SECONDS
    cell = Cell(SUBJECTS[name], conditions, "tcp+udp", seconds, cut=False)
    try:
        return [{"varied": "round_trip", **row} for row in cell.measure()]
    except KugliceError as error:
        left_out.append(f"{cell.label}: {error}")
        return []


def _told(scene: str, rate: float, effort: Effort, left_out: list[str]) -> Rows:
    seconds = QUICK_SECONDS if effort.quick else SECONDS
    try:
        rows = measured(scene, seconds, region_rate=rate)
    except KugliceError as error:
        left_out.append(f"view of {scene}, told {rate:g} times per second: {error}")
        return []
    return [{"varied": "region_rate", "region_rate": rate, **row} for row in rows]
