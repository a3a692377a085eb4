"""What the world's own rules do in it: inputs of client 0, from whoever runs the server."""

from __future__ import annotations

import logging
import threading

from kuglice import World
from kuglice.errors import InputError
from kuglice.inputs import OWNER, Input, check
from kuglice_server.counters import Counters

__all__ = ["Owner"]

log = logging.getLogger(__name__)

KINDS = frozenset({"spawn", "remove", "attract", "kick"})
"""Who comes and goes is for liveliness to say, and thrust acts on a ball of one's own."""
MAX_WAITING = 256
"""Inputs for one tick: all of a tick, clients' inputs too, must fit into one batch."""


class Owner:
    """Its inputs act in the tick that comes next, before those of clients. Safe from any thread."""

    def __init__(self, world: World, counters: Counters) -> None:
        self._world = world
        self._counters = counters
        self._sequence = 0
        self._waiting: list[Input] = []
        self._lock = threading.Lock()

    def act(self, given: Input) -> Input:
        """Take an input; returns it with the numbers under which it will act.

        Raises InputError for one that is not the owner's to make, that is impossible now, or one too many.
        """
        with self._lock:
            if given.kind not in KINDS:
                raise InputError(
                    f"{given.kind}: not for the owner of a world, which makes {', '.join(sorted(KINDS))}"
                )
            if len(self._waiting) >= MAX_WAITING:
                raise InputError(
                    f"{given.kind}: {MAX_WAITING} inputs of the owner wait for the next tick already"
                )
            mine: Input = given.model_copy(update={"client": OWNER, "sequence": self._sequence + 1})
            check(mine, self._world.scene, self._world)
            self._sequence += 1
            self._waiting.append(mine)
            return mine

    def due(self) -> list[Input]:
        """What was asked for since the last tick."""
        with self._lock:
            due, self._waiting = self._waiting, []
            return due

    def left_out(self, one: Input, why: str) -> None:
        """An input cannot act after all: nobody is told of it but the log and the counters."""
        log.warning("%s %d of the owner does not act: %s", one.kind, one.sequence, why)
        self._counters.add("left_out")
