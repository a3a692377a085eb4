"""Few balls: what a tick costs when there is hardly anything to do, without and with a call from Python for each."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from kuglice.lab.bench.case import Contender, Measure, raced
from kuglice.lab.stopwatch import Work
from kuglice.model import Model
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["CASES"]

BALLS = (10, 100)
BALL_TICKS = 200_000
UNIT = "ns per tick"


def _few(balls: int) -> Mapping[str, Contender]:
    ticks = BALL_TICKS // balls
    return {
        f"{contacts}, {way}": Contender(prepare(balls, contacts, ticks), ticks, UNIT)
        for contacts in ("overlap", "event")
        for way, prepare in (("run(n)", _running), ("step() each", _stepping))
    }


def _world(balls: int, contacts: str) -> World:
    scene = gas(n=balls)
    # The broadphase that the planner takes for so few.
    broadphase = World(scene).model.broadphase
    return World(scene, Model(integrator="verlet", contacts=contacts, broadphase=broadphase))


def _running(balls: int, contacts: str, ticks: int) -> Callable[[], Work]:
    world = _world(balls, contacts)
    return lambda: lambda: world.run(ticks)


def _stepping(balls: int, contacts: str, ticks: int) -> Callable[[], Work]:
    world = _world(balls, contacts)

    def work() -> None:
        step = world.step
        for _ in range(ticks):
            step()

    return lambda: work


CASES: dict[str, Measure] = {
    f"each tick, {balls} balls": raced(lambda balls=balls: _few(balls))  # type: ignore[misc]
    for balls in BALLS
}
