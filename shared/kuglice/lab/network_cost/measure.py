"""Games over links of growing round trip."""

from __future__ import annotations

from functools import partial

from kuglice.errors import KugliceError
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.network.cell import Cell
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.subjects import SUBJECTS
from kuglice.lab.network.table import JITTER, LOSS
from kuglice.lab.rows import Rows

__all__ = ["PLAYED", "jobs"]

ROUND_TRIPS = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)
QUICK_ROUND_TRIPS = (0.0, 0.15)
SECONDS, QUICK_SECONDS = 6.0, 2.0
PLAYED = ("arena", "arena, one acts")


def jobs(effort: Effort, left_out: list[str]) -> list[Job]:
    """One per game."""
    return [
        Job(f"{name} at {1000 * round_trip:g} ms", partial(_at, name, round_trip, effort, left_out))
        for name in PLAYED
        for round_trip in (QUICK_ROUND_TRIPS if effort.quick else ROUND_TRIPS)
    ]


def _at(name: str, round_trip: float, effort: Effort, left_out: list[str]) -> Rows:
    conditions = Conditions(round_trip=round_trip, jitter=JITTER if round_trip else 0.0, loss=LOSS)
    seconds = QUICK_SECONDS if effort.quick else SECONDS
    cell = Cell(SUBJECTS[name], conditions, "tcp+udp", seconds, cut=False)
    try:
        return [{"varied": "round_trip", **row} for row in cell.measure()]
    except KugliceError as error:
        left_out.append(f"{cell.label}: {error}")
        return []
