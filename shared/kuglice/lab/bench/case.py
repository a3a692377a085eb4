"""One case: what is measured side by side, repeat by repeat, and told in one unit."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from kuglice.errors import KugliceError
from kuglice.lab.rows import Row
from kuglice.lab.running import CannotRunError
from kuglice.lab.stopwatch import Prepare, race

__all__ = ["Case", "Contender", "Measure", "Samples", "raced"]


@dataclass(frozen=True)
class Samples:
    """What one contender gave, repeat by repeat; less is better."""

    values: tuple[float, ...]
    unit: str


Measure = Callable[[int], Mapping[str, Samples]]
"""Of so many repeats, by contender; the first one is what the others are compared with."""


@dataclass(frozen=True)
class Contender:
    """Prepares work; its time is divided by `operations` and told in `unit`."""

    prepare: Prepare
    operations: float
    unit: str = "ns per ball-step"


def raced(make: Callable[[], Mapping[str, Contender]]) -> Measure:
    """Contenders that take turns. They are made when their turn comes: large scenes do not wait in memory."""

    def measure(repeats: int) -> Mapping[str, Samples]:
        contenders = make()
        timings = race({name: each.prepare for name, each in contenders.items()}, repeats)
        return {
            name: Samples(
                tuple(1e9 * second / each.operations for second in timings[name].seconds), each.unit
            )
            for name, each in contenders.items()
        }

    return measure


@dataclass
class Case:
    """A line-up and its rows."""

    name: str
    measure: Measure
    repeats: int = 5
    left_out: list[str] = field(default_factory=list)

    def run(self) -> list[Row]:
        """One row per contender, compared with the first one; none, and the reason left, if it cannot run."""
        rows: list[Row] = []
        try:
            measured = self.measure(self.repeats)
        except (CannotRunError, KugliceError) as reason:
            self.left_out.append(f"all of it: {reason}")
            return []
        for name, samples in measured.items():
            minimum = min(samples.values)
            first = float(rows[0]["minimum"]) if rows else minimum
            rows.append(
                {
                    "case": self.name,
                    "contender": name,
                    "minimum": minimum,
                    "median": statistics.median(samples.values),
                    "unit": samples.unit,
                    "relative": minimum / first if first else 1.0,
                    "repeats": len(samples.values),
                }
            )
        return rows
