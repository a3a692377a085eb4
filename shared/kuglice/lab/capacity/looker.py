"""A session that looks: subscribed to the regions of a rectangle of its own, all of which it decodes and unpacks."""

from __future__ import annotations

import random
from typing import Any

import zenoh

from kuglice.errors import NetworkError, ProtocolError
from kuglice.protocol import (
    MAX_REGION_BALLS,
    Keys,
    Nodes,
    Region,
    ViewAbout,
    client_configuration,
    close_session,
    decode,
    open_session,
)

__all__ = ["SIDE", "Looker"]

TIMEOUT = 10.0
SIDE = 4
"""Regions across and up."""


class Looker:
    """What a view is to the server and to the network; it steps nothing. Raises NetworkError."""

    def __init__(self, endpoint: str, keys: Keys) -> None:
        self.messages = 0
        self.bytes = 0
        self.malformed = 0
        self._span: dict[int, tuple[int, int]] = {}
        self._session = open_session(client_configuration([endpoint], timeout=TIMEOUT))
        about = _about(self._session, keys)
        self._every = max(1, round(about.rate / about.regions.rate))
        nodes = Nodes(tuple(about.scene["box"]), about.regions.depth)
        self._packer = about.regions.packer(nodes.box)
        self._subscribers: list[Any] = [
            self._session.declare_subscriber(
                keys.region(0, nodes.path(node)), zenoh.handlers.Callback(self._hear, indirect=False)
            )
            for node in _somewhere(nodes)
        ]

    def report(self) -> dict[str, int]:
        """What came so far, and how much there was to come: `told`."""
        return {
            "messages": self.messages,
            "bytes": self.bytes,
            "malformed": self.malformed,
            "told": sum((last - first) // self._every + 1 for first, last in dict(self._span).values()),
        }

    def close(self) -> None:
        """Leave."""
        close_session(self._session, self._subscribers, timeout=1.0)

    def _hear(self, sample: zenoh.Sample) -> None:
        self.messages += 1
        self.bytes += len(sample.payload)
        try:
            region = decode(sample.payload, Region)
            self._packer.unpack(region.balls, MAX_REGION_BALLS)
        except ProtocolError:
            self.malformed += 1
            return
        first, _ = self._span.get(region.node, (region.tick, region.tick))
        self._span[region.node] = (first, region.tick)


def _somewhere(nodes: Nodes) -> frozenset[int]:
    """The nodes of a square, wherever it may be."""
    left, bottom, right, top = nodes.box
    across = 1 << nodes.depth
    side = min(SIDE, across)
    width, height = (right - left) / across, (top - bottom) / across
    column, row = (random.randrange(across - side + 1) + 0.5 for _ in range(2))
    x, y = left + column * width, bottom + row * height
    return nodes.cover((x, y, x + (side - 1) * width, y + (side - 1) * height))


def _about(session: zenoh.Session, keys: Keys) -> ViewAbout:
    for reply in session.get(keys.view, timeout=TIMEOUT):
        if reply.ok is not None:
            return decode(reply.ok.payload, ViewAbout)
    raise NetworkError(f"{keys.view}: nobody answers")
