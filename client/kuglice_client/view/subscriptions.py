"""What a view subscribes to, changed as it moves: as few keys as the nodes allow, never a moment without one."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

import zenoh

from kuglice.protocol import Keys, Nodes

__all__ = ["Subscriptions"]

WAITING_MESSAGES = 8192
"""Of one view; the oldest give way, for the newest tick wins."""


class Subscriptions:
    """What comes in waits in `samples`, put there by Zenoh's threads."""

    def __init__(self, session: zenoh.Session, keys: Keys) -> None:
        self._session = session
        self._keys = keys
        self._by_key: dict[str, zenoh.Subscriber[None]] = {}
        self.samples: deque[zenoh.Sample] = deque(maxlen=WAITING_MESSAGES)
        self.changes = 0

    @property
    def keys(self) -> frozenset[str]:
        """Subscribed to now."""
        return frozenset(self._by_key)

    def want(self, nodes: Nodes, paces: Mapping[int, int]) -> None:
        """Subscribe to these nodes, each at its pace, and to who plays; and to nothing else any more."""
        wanted = {self._keys.holding}
        for pace in set(paces.values()):
            chosen = [node for node, its in paces.items() if its == pace]
            for path in nodes.merged(chosen):
                whole = len(path) == nodes.depth
                wanted.add((self._keys.region if whole else self._keys.regions)(pace, path))
        for key in wanted - self._by_key.keys():
            self._subscribe(key)
            self.changes += 1
        for key in self._by_key.keys() - wanted:
            self._by_key.pop(key).undeclare()  # type: ignore[no-untyped-call]
            self.changes += 1

    def go_over(self, session: zenoh.Session) -> None:
        """Subscribe to the same in another session; the one before is closed by whoever opened it."""
        self._session = session
        for key in self._by_key:
            self._subscribe(key)

    def _subscribe(self, key: str) -> None:
        self._by_key[key] = self._session.declare_subscriber(key, self.samples.append)
