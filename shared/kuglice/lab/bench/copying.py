"""What saving, copying, hashing and rolling back cost at 10,000 balls, beside a memcpy of the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from kuglice.lab.bench.case import Contender, Measure, raced
from kuglice.lab.stopwatch import Work
from kuglice.model import Model
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["CASES"]

BALLS = 10_000
TIMES = 50
ROLLBACK = 8
"""Ticks that a client runs again when the server's inputs differ from its prediction."""
CLONED_BYTES = 60
"""Per ball: position, velocity, radius, mass, id, place in memory."""


def _again(call: Callable[[], object]) -> Callable[[], Work]:
    def work() -> None:
        for _ in range(TIMES):
            call()

    return lambda: work


def _memcpy(bytes_: int) -> Callable[[], object]:
    source, target = np.ones(bytes_, np.uint8), np.ones(bytes_, np.uint8)
    return lambda: np.copyto(target, source)


def _copies() -> Mapping[str, Contender]:
    world = World(gas(n=BALLS), Model(integrator="verlet", contacts="overlap"))
    world.run(10)
    other = world.clone()
    data = world.snapshot()
    calls: dict[str, Callable[[], object]] = {
        "memcpy of a snapshot's bytes": _memcpy(len(data)),
        "memcpy of a world's bytes": _memcpy(CLONED_BYTES * BALLS),
        "copy_from": lambda: other.copy_from(world),
        "clone": world.clone,
        "snapshot": world.snapshot,
        "restore": lambda: World.restore(world.scene, data, world.model),
        "state_hash": lambda: world.state_hash,
    }
    return {name: Contender(_again(call), TIMES, "ns per call") for name, call in calls.items()}


def _rollback() -> Mapping[str, Contender]:
    found = {}
    for contacts in ("overlap", "event"):
        confirmed = World(gas(n=BALLS), Model(integrator="verlet", contacts=contacts))
        confirmed.run(10)
        predicted = confirmed.clone()

        def work(predicted: World = predicted, confirmed: World = confirmed) -> None:
            predicted.copy_from(confirmed)
            predicted.run(ROLLBACK)

        found[contacts] = Contender(lambda work=work: work, 1, "ns per rollback")  # type: ignore[misc]
    return found


CASES: dict[str, Measure] = {
    f"copies of {BALLS:,}": raced(_copies),
    f"rollback of {ROLLBACK} ticks, {BALLS:,}": raced(_rollback),
}
