"""One case: contenders that take turns, and the unit in which their times are told."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from kuglice.lab.rows import Row
from kuglice.lab.running import CannotRunError, Make, Running
from kuglice.lab.stopwatch import Prepare, Work, race
from kuglice.scene import Scene
from kuglice.world import World

__all__ = ["Case", "Contender", "stepping"]


@dataclass(frozen=True)
class Contender:
    """Prepares work; its time is divided by `operations` and told in `unit`."""

    prepare: Prepare
    operations: float
    unit: str = "ns per ball-step"


@dataclass
class Case:
    """A line-up. `make` builds it when its turn comes, so that large scenes do not wait in memory."""

    name: str
    make: Callable[[], Mapping[str, Contender]]
    repeats: int = 5
    left_out: list[str] = field(default_factory=list)

    def run(self) -> list[Row]:
        """One row per contender, compared with the first one."""
        contenders = self.make()
        timings = race({name: each.prepare for name, each in contenders.items()}, self.repeats)
        rows: list[Row] = []
        for name, timing in timings.items():
            each = contenders[name]
            unit = 1e9 / each.operations
            first = rows[0]["minimum"] if rows else timing.minimum * unit
            rows.append(
                {
                    "case": self.name,
                    "contender": name,
                    "minimum": timing.minimum * unit,
                    "median": timing.median * unit,
                    "unit": each.unit,
                    "relative": timing.minimum * unit / float(first),
                    "repeats": timing.repeats,
                }
            )
        return rows


def stepping(
    scene: Scene, makes: Mapping[str, Make], ticks: int, left_out: list[str]
) -> dict[str, Contender]:
    """Contenders that each run the same `ticks` from the same initial state in every round."""
    found = {}
    for name, make in makes.items():
        try:
            ready = _ready(scene, make, max(1, ticks // 4))
        except CannotRunError as reason:
            left_out.append(f"{name}: {reason}")
            continue

        def prepare(ready: Callable[[], Running] = ready) -> Work:
            run = ready().run
            return lambda: run(ticks)

        found[name] = Contender(prepare, ticks * max(len(scene.balls), 1))
    return found


def _ready(scene: Scene, make: Make, warm: int) -> Callable[[], Running]:
    """Gives the world as it is after a few ticks, which fill caches and scratch memory."""
    world = make(scene)
    if isinstance(world, World):
        copy = world.clone()

        def again() -> Running:
            # Into the same memory: a fresh clone would pay for its first touch.
            copy.copy_from(world)
            copy.run(warm)
            return copy

        return again

    def rebuilt() -> Running:
        made = make(scene)
        made.run(warm)
        return made

    return rebuilt
