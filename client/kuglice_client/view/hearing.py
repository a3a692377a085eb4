"""What comes in, read: bounded before it is decoded, and checked against what a server could say by now."""

from __future__ import annotations

import numpy as np

from kuglice.errors import ProtocolError
from kuglice.protocol import MAX_REGION_BALLS, Keys, Nodes, Payload, Region, ViewAbout, decode
from kuglice_client.view.told import Told

__all__ = ["Hearing"]

DRIFT = 1.05
"""How much faster than it says a server's clock may run."""
AHEAD_SECONDS = 10.0
"""Which a server that was late may catch up with in no time."""


class Hearing:
    """Of one run of a server; `now`: when it said `about`, in seconds of a monotonic clock."""

    def __init__(self, about: ViewAbout, nodes: Nodes, *, now: float) -> None:
        self._about = about
        self._nodes = nodes
        self._began = now
        self.packer = about.regions.packer(nodes.box)

    def region(self, key: str, payload: Payload, *, now: float) -> Told | None:
        """What is told; None if it is of another run of the server. Raises ProtocolError for what cannot be."""
        message = decode(payload, Region)
        if message.epoch != self._about.epoch:
            return None
        node = message.node
        if node >= self._nodes.count or Keys.node_of(key) != self._nodes.path(node):
            raise ProtocolError(f"region {node} of {self._nodes.count} under the key {key}")
        self.check_tick(message.tick, now=now)
        told = Told(message.tick, node, *self.packer.unpack(message.balls, MAX_REGION_BALLS))
        self._check_places(told)
        return told

    def check_tick(self, tick: int, *, now: float) -> None:
        """Raises ProtocolError for a tick that cannot be yet: it would make everything else too old."""
        seconds = DRIFT * (now - self._began) + AHEAD_SECONDS
        newest = self._about.tick + round(seconds * self._about.rate)
        if tick > newest:
            raise ProtocolError(f"tick {tick}: at most {newest} can have been by now")

    def _check_places(self, told: Told) -> None:
        """Rounding takes a ball out of its node by no more than it rounds."""
        if not len(told.id):
            return
        left, bottom, right, top = self._nodes.rectangle(told.node)
        slack = self._about.regions.position_quantum
        inner = np.clip(told.position, (left, bottom), (right, top))
        off = np.abs(told.position - inner) > slack
        wrong = off.any(axis=1) & (self.packer.node(told.position) != told.node)
        if wrong.any():
            first = int(np.flatnonzero(wrong)[0])
            raise ProtocolError(
                f"region {told.node}: ball {told.id[first]} at {told.position[first].tolist()}, "
                f"outside of {(left, bottom, right, top)}"
            )
