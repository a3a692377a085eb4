"""The process of many listeners: real sessions, each subscribed as a client would be, that decode all they get.

`python -m kuglice.lab.capacity.listeners ENDPOINT WORLD KIND`. Each line on stdin is a number of sessions to add, or
empty for a report; each is answered by a line of JSON. At the end of stdin it ends.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Any

import zenoh

from kuglice.errors import ProtocolError
from kuglice.lab.capacity.looker import Looker
from kuglice.protocol import Keys, Tick, client_configuration, close_session, decode, open_session

__all__ = ["Listener"]

TIMEOUT = 10.0


class Listener:
    """One session that hears the tick stream: what a full client is to the server."""

    def __init__(self, endpoint: str, keys: Keys) -> None:
        self.messages = 0
        self.bytes = 0
        self.malformed = 0
        self.first: int | None = None
        self.newest = -1
        self._session = open_session(client_configuration([endpoint], timeout=TIMEOUT))
        self._subscriber: Any = self._session.declare_subscriber(
            keys.tick, zenoh.handlers.Callback(self._hear, indirect=False)
        )

    def report(self) -> dict[str, int]:
        """What came so far, and how much there was to come: `told`."""
        told = 0 if self.first is None else self.newest + 1 - self.first
        return {
            "messages": self.messages,
            "bytes": self.bytes,
            "malformed": self.malformed,
            "told": told,
        }

    def close(self) -> None:
        """Leave."""
        close_session(self._session, [self._subscriber], timeout=1.0)

    def _hear(self, sample: zenoh.Sample) -> None:
        self.messages += 1
        self.bytes += len(sample.payload)
        try:
            tick = decode(sample.payload, Tick).end - 1
        except ProtocolError:
            self.malformed += 1
            return
        self.first = tick if self.first is None else self.first
        self.newest = max(self.newest, tick)


KINDS: dict[str, Callable[[str, Keys], Listener | Looker]] = {"client": Listener, "view": Looker}


def main(endpoint: str, world: str, kind: str) -> None:
    """Serve stdin."""
    listeners: list[Listener | Looker] = []
    for line in sys.stdin:
        if line.strip():
            listeners += [KINDS[kind](endpoint, Keys(world)) for _ in range(int(line))]
        print(json.dumps([each.report() for each in listeners]), flush=True)
    for each in listeners:
        each.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
