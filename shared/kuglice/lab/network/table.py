"""All cells of `kuglice bench network`."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from kuglice.lab.network.cell import Cell
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.subjects import SUBJECTS

__all__ = ["cells", "snapshot_cells"]

ROUND_TRIPS = (0.0, 0.050, 0.150, 0.300)
JITTER = 0.2
LOSS = 0.02
PROTOCOLS = ("tcp+udp", "tcp")
TARGET = Conditions(round_trip=0.150, jitter=JITTER, loss=LOSS)
"""The conditions for which targets are stated."""
SNAPSHOTS = (6, 15, 30, 60, 120, 600)
"""Ticks from one published snapshot to the next."""


def cells(
    *, quick: bool, seconds: float, link: str, cut_everywhere: bool = False, only: Sequence[str] = ()
) -> list[Cell]:
    """In the order in which they are played; `quick` leaves one condition and small scenes.

    The link is cut under the conditions of the targets, or everywhere.
    """
    conditions = [TARGET] if quick else _conditions()
    names = [
        name
        for name in SUBJECTS
        if (not quick or "10,000" not in name) and (not only or any(part in name for part in only))
    ]
    return [
        Cell(SUBJECTS[name], each, protocols, seconds, link, cut=cut_everywhere or each == TARGET)
        for name, each, protocols in product(names, conditions, PROTOCOLS)
    ]


def snapshot_cells(*, seconds: float, link: str) -> list[Cell]:
    """The rate of snapshots against what it costs and gives, under the conditions of the targets."""
    return [
        Cell(SUBJECTS["rain 1,000"], TARGET, "tcp", seconds, link, cut=False, snapshot_every=every)
        for every in SNAPSHOTS
    ]


def _conditions() -> list[Conditions]:
    """Every round trip with loss, without jitter and with it."""
    return [
        Conditions(round_trip=round_trip, jitter=jitter, loss=LOSS)
        for round_trip, jitter in product(ROUND_TRIPS, (0.0, JITTER))
        # A share of nothing is nothing.
        if round_trip or not jitter
    ]
