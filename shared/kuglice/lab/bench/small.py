"""Few balls: what a tick costs when there is hardly anything to do, the call from Python included."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from kuglice.lab.bench.case import Contender
from kuglice.lab.stopwatch import Work
from kuglice.model import Model
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["CASES"]

TICKS = 20_000
UNIT = "ns per tick"


def _ten() -> Mapping[str, Contender]:
    return {
        f"{broadphase}, {way}": Contender(prepare(broadphase), TICKS, UNIT)
        for broadphase in ("brute", "loose_quadtree")
        for way, prepare in (("run(n)", _running), ("step() each", _stepping))
    }


def _world(broadphase: str) -> World:
    return World(gas(n=10), Model(integrator="verlet", contacts="overlap", broadphase=broadphase))


def _running(broadphase: str) -> Callable[[], Work]:
    world = _world(broadphase)
    return lambda: lambda: world.run(TICKS)


def _stepping(broadphase: str) -> Callable[[], Work]:
    world = _world(broadphase)

    def work() -> None:
        step = world.step
        for _ in range(TICKS):
            step()

    return lambda: work


CASES: dict[str, Callable[[], Mapping[str, Contender]]] = {"gas 10": _ten}
