"""What saving, copying, hashing and rolling back cost at 10,000 balls, beside a memcpy of the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from kuglice.lab.bench.case import Contender
from kuglice.lab.stopwatch import Work
from kuglice.model import Model
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["CASES"]

TIMES = 50
ROLLBACK = 8
"""Ticks that a client runs again when the server's inputs differ from its prediction."""


def _again(call: Callable[[], object]) -> Callable[[], Work]:
    def work() -> None:
        for _ in range(TIMES):
            call()

    return lambda: work


def _copies() -> Mapping[str, Contender]:
    world = World(gas(n=10_000), Model(integrator="verlet", contacts="overlap"))
    world.run(10)
    other = world.clone()
    data = world.snapshot()
    source = np.frombuffer(data, np.uint8)
    target = np.empty_like(source)
    calls: dict[str, Callable[[], object]] = {
        f"memcpy of a snapshot's {len(data):,} bytes": lambda: np.copyto(target, source),
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
        confirmed = World(gas(n=10_000), Model(integrator="verlet", contacts=contacts))
        predicted = confirmed.clone()

        def work(predicted: World = predicted, confirmed: World = confirmed) -> None:
            predicted.copy_from(confirmed)
            predicted.run(ROLLBACK)

        found[contacts] = Contender(lambda work=work: work, 1, "ns per rollback")  # type: ignore[misc]
    return found


CASES: dict[str, Callable[[], Mapping[str, Contender]]] = {
    "copies of 10,000": _copies,
    f"rollback of {ROLLBACK} ticks, 10,000": _rollback,
}
