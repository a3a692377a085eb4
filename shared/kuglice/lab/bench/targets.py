"""What the project wants to reach, judged by the figures of one run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from kuglice.lab.rows import Row

__all__ = ["TARGETS", "Target", "judged"]

Of = Callable[[str, str], float]
"""The figure of a case and a contender."""


@dataclass(frozen=True)
class Target:
    """A bound, and how the figure that it is held against comes of others."""

    what: str
    bound: float
    unit: str
    figure: Callable[[Of], float]
    at_least: bool = False


NS = "ns per ball-step"
HEADLINE = "gas 10,000"
MILLION = "gas 1,000,000, 60 ticks and a hash, 2 threads"
GRAVITY = "gravity, 10,000, event"
RADII = "radii, 10,000"
MEMORY = "memory at the peak, 1,000,000"
COPIES = "copies of 10,000"
SNAPSHOT, CLONED = "memcpy of a snapshot's bytes", "memcpy of a world's bytes"
ROLLBACK = "rollback of 8 ticks, 10,000"
SERVER = "server, 10,000 balls at 60 Hz"


def _ratio(case: str, contender: str, base: str) -> Callable[[Of], float]:
    return lambda of: of(case, contender) / of(case, base)


def _scaled(case: str, contender: str, factor: float) -> Callable[[Of], float]:
    return lambda of: of(case, contender) * factor


def _ticks_per_second(contacts: str) -> Callable[[Of], float]:
    return lambda of: 1e9 / of(MILLION, contacts)


TARGETS: Sequence[Target] = (
    Target("gas 10,000, overlap, 1 thread", 20, NS, _scaled(HEADLINE, "overlap", 1)),
    Target("the same, pymunk / ours", 35, "times", _ratio(HEADLINE, "pymunk", "overlap"), at_least=True),
    Target(
        "the same, numba grid / ours", 6, "times", _ratio(HEADLINE, "numba grid", "overlap"), at_least=True
    ),
    Target("gas 10,000, event, 1 thread", 60, NS, _scaled(HEADLINE, "event", 1)),
    *(
        Target(
            f"gas 1,000,000, {contacts}, 2 threads, a hash every 60 ticks",
            bound,
            "ticks per second",
            _ticks_per_second(contacts),
            at_least=True,
        )
        for contacts, bound in (("overlap", 60), ("event", 20))
    ),
    Target("gas under gravity / gas, event", 2, "times", _ratio(GRAVITY, "gas under gravity", "gas")),
    Target("rain / gas, event", 2, "times", _ratio(GRAVITY, "rain", "gas")),
    *(
        Target(
            f"{radii} / equal radii, {contacts}",
            bound,
            "times",
            _ratio(RADII, f"{radii}, {contacts}", f"radii equal, {contacts}"),
        )
        for radii, bound in (("radii 0.1 to 2", 2), ("radii 0.01 to 10", 4))
        for contacts in ("overlap", "event")
    ),
    *(
        Target(
            f"{balls} balls, {contacts}, {way}",
            bound * balls / 10,
            "us per tick",
            _scaled(f"each tick, {balls} balls", f"{contacts}, {way}", 1e-3),
        )
        for balls, contacts, way, bound in (
            (10, "overlap", "run(n)", 1.5),
            (10, "event", "run(n)", 1.5),
            (10, "overlap", "step() each", 3.0),
            (10, "event", "step() each", 3.0),
        )
    ),
    *(
        Target(
            f"1,000,000 / 1,000 balls, {contacts}",
            2,
            "times",
            _ratio(f"growth, {contacts}", "1,000,000 balls", "1,000 balls"),
        )
        for contacts in ("overlap", "event")
    ),
    *(
        Target(f"memory of 1,000,000 balls, {contacts}", 160, "bytes per ball", _scaled(MEMORY, contacts, 1))
        for contacts in ("overlap", "event")
    ),
    Target("clone / memcpy", 1.3, "times", _ratio(COPIES, "clone", CLONED)),
    Target("copy_from / memcpy", 1.3, "times", _ratio(COPIES, "copy_from", SNAPSHOT)),
    Target("snapshot / memcpy", 2, "times", _ratio(COPIES, "snapshot", SNAPSHOT)),
    Target("state_hash / memcpy", 2, "times", _ratio(COPIES, "state_hash", SNAPSHOT)),
    *(
        Target(f"rollback of 8 ticks, 10,000 balls, {contacts}", 5, "ms", _scaled(ROLLBACK, contacts, 1e-6))
        for contacts in ("overlap", "event")
    ),
    *(
        Target(
            f"server of 10,000 balls at 60 Hz, {contacts}",
            25,
            "percent of one core",
            _scaled(SERVER, contacts, 1),
        )
        for contacts in ("overlap", "event")
    ),
)


def judged(rows: Sequence[Row]) -> tuple[list[Row], list[str]]:
    """A row for each target that these rows have figures for; the names of the others."""
    found: list[Row] = []
    missing: list[str] = []
    for target in TARGETS:
        try:
            minimum, median = (_judge(target, rows, statistic) for statistic in ("minimum", "median"))
        except KeyError:
            missing.append(target.what)
            continue
        met = minimum >= target.bound if target.at_least else minimum <= target.bound
        found.append(
            {
                "case": "target",
                "contender": target.what,
                "minimum": minimum,
                "median": median,
                "unit": target.unit,
                "target": f"{'>=' if target.at_least else '<='} {target.bound:g}",
                "verdict": "met" if met else "missed",
            }
        )
    return found, missing


def _judge(target: Target, rows: Sequence[Row], statistic: str) -> float:
    figures = {(row["case"], row["contender"]): float(row[statistic]) for row in rows}
    return target.figure(lambda case, contender: figures[case, contender])
