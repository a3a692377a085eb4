"""Measurements in small pieces, so that a progress bar can tell how far they are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from kuglice.lab.rows import Row, Rows

__all__ = ["Effort", "Job", "done"]


@dataclass(frozen=True)
class Effort:
    """How much to measure."""

    quick: bool = False
    peers: bool = False
    repeats: int = 5
    seeds: tuple[int, ...] = (1, 2, 3)


@dataclass(frozen=True)
class Job:
    """A piece of work that yields rows."""

    label: str
    measure: Callable[[], Rows]


@dataclass
class Measured:
    """All rows of one chart, and what had to be left out, with the reason."""

    rows: list[Row] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)


def done(jobs: Sequence[Job], note: Callable[[str], None] = lambda _: None) -> list[Row]:
    """Run them in order; `note` hears each label before its job."""
    rows: list[Row] = []
    for job in jobs:
        note(job.label)
        rows += job.measure()
    return rows
