"""Which nodes somebody looks at: a quadtree of publishers, grown only where there are subscribers.

A publisher of `region/0/1/**`, which never puts anything, says by its audience whether anybody looks at anything below
node 1. While nobody looks at all, there is only the root of each pace.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import zenoh

from kuglice.protocol import PACES, Keys
from kuglice_server.regions.audience import Audience

__all__ = ["Watch", "Watched"]

DECLARED_PER_TURN = 256
"""Declaring takes tens of microseconds each, and a tick waits for it."""
WITHDRAWN_PER_TURN = 64
MOST_PUBLISHERS = 8192
"""Publishers of nodes that nobody looks at any more are kept, for a view may come back, up to so many."""


@dataclass
class _Node:
    number: int
    path: tuple[int, ...]
    publisher: zenoh.Publisher
    audience: Audience
    below: list[_Node] = field(default_factory=list)


@dataclass(frozen=True)
class Watched:
    """A node of the finest level that somebody looks at, at a pace, and where to put what is told of it."""

    pace: int
    node: int
    publisher: zenoh.Publisher


class Watch:
    """The trees of publishers of one server, one for each pace."""

    def __init__(self, session: zenoh.Session, keys: Keys, depth: int) -> None:
        self._session = session
        self._keys = keys
        self._depth = depth
        self._count = 0
        self._roots = [self._declare(pace, 0, ()) for pace in range(PACES)]

    @property
    def publishers(self) -> int:
        """How many are declared."""
        return self._count

    @property
    def declared(self) -> tuple[zenoh.Publisher, ...]:
        """For closing."""
        return tuple(node.publisher for root in self._roots for node in _all(root))

    def looked_at(self) -> list[Watched]:
        """Of a view that has just come, nodes may be missing that the next turn finds."""
        found: list[Watched] = []
        allowance = DECLARED_PER_TURN
        for pace, root in enumerate(self._roots):
            waiting = [root]
            while waiting:
                node = waiting.pop()
                if not node.audience.present():
                    continue
                if len(node.path) == self._depth:
                    found.append(Watched(pace, node.number, node.publisher))
                    continue
                if not node.below:
                    if allowance < 4:
                        continue
                    allowance -= 4
                    node.below = [
                        self._declare(pace, node.number << 2 | quarter, (*node.path, quarter))
                        for quarter in range(4)
                    ]
                waiting += node.below
        if self._count > MOST_PUBLISHERS:
            self._withdraw()
        return found

    def _declare(self, pace: int, number: int, path: tuple[int, ...]) -> _Node:
        key: Callable[[int, tuple[int, ...]], str]
        key = self._keys.region if len(path) == self._depth else self._keys.regions
        self._count += 1
        publisher = self._session.declare_publisher(
            key(pace, path),
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.DATA,
        )
        return _Node(number, path, publisher, Audience(publisher, number))

    def _withdraw(self) -> None:
        allowance = WITHDRAWN_PER_TURN
        for root in self._roots:
            for node in list(_all(root)):
                if allowance <= 0:
                    return
                if node.below and not node.audience.present():
                    gone = [one for below in node.below for one in _all(below)]
                    node.below = []
                    for one in gone:
                        one.publisher.undeclare()  # type: ignore[no-untyped-call]
                    self._count -= len(gone)
                    allowance -= len(gone)


def _all(node: _Node) -> Iterator[_Node]:
    yield node
    for below in node.below:
        yield from _all(below)
