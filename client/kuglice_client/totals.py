"""The figures of a session, of a client or a view, over all the runs of the server that it lived through."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

__all__ = ["Figure", "Totals"]

Figure = int | float
LARGEST = frozenset({"deepest_rollback", "worst_correction_radii"})
"""Figures whose total is the largest one; all others add up."""


@dataclass
class Totals:
    """What is counted whatever the run, and the figures of server runs that are over."""

    messages_thrown_away: int = 0
    malformed_snapshots: int = 0
    rejoins: int = 0
    past: dict[str, Figure] = field(default_factory=dict)

    def rejoin(self, figures: Mapping[str, Figure]) -> None:
        """Another run of the server begins: add the figures of the one that is over."""
        self.past = self.with_past(figures)
        self.rejoins += 1

    def with_past(self, figures: Mapping[str, Figure]) -> dict[str, Figure]:
        """The figures of the present run and of those before it together."""
        return {
            name: max(value, self.past.get(name, 0)) if name in LARGEST else value + self.past.get(name, 0)
            for name, value in figures.items()
        }
