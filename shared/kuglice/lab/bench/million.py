"""A million balls on two threads, with the state hash of every second."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from kuglice.lab.bench.case import Contender, Measure, raced
from kuglice.lab.stopwatch import Work
from kuglice.model import Model
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["CASES"]

BALLS = 1_000_000
THREADS = 2
TICKS = 60
WARM = 5


def _contenders() -> Mapping[str, Contender]:
    scene = gas(n=BALLS)
    return {
        contacts: Contender(
            _second(World(scene, Model(integrator="verlet", contacts=contacts), threads=THREADS)),
            TICKS,
            "ns per tick",
        )
        for contacts in ("overlap", "event")
    }


def _second(world: World) -> Callable[[], Work]:
    world.run(WARM)

    def work() -> int:
        world.run(TICKS)
        return world.state_hash

    return lambda: work


CASES: dict[str, Measure] = {
    f"gas {BALLS:,}, {TICKS} ticks and a hash, {THREADS} threads": raced(_contenders)
}
