"""Datagrams that nobody reads any more: a flaw of Zenoh, which nothing but a new process heals.

Zenoh reads the datagrams of all links in one place, and waits there until the link takes what came for it. A link that
ends in between takes nothing any more: then no datagram is read again. A stranger who sends a few that mean nothing can
bring that about. All goes on over the streams alone, some seconds later, and without a word; so here is one.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Sequence
from pathlib import Path

from kuglice.protocol.endpoints import host_and_port, wants_datagrams

__all__ = ["UnreadDatagrams"]

log = logging.getLogger(__name__)

TABLES = (Path("/proc/self/net/udp"), Path("/proc/self/net/udp6"))
"""Only Linux tells how much waits in a socket; elsewhere nothing is noticed."""
LOCAL_ADDRESS, QUEUES = 1, 4
"""Columns: the port comes after the colon, and so do the bytes that wait to be read."""
LOOK_SECONDS = 1.0
LOOKS = 5
"""In a row at which something waited and none of it had been read."""


class UnreadDatagrams:
    """Looks after the ports of the endpoints in `listen` that take datagrams, and warns once for each."""

    def __init__(self, listen: Sequence[str], *, tables: Sequence[Path] = TABLES) -> None:
        self._tables = tables
        self._endpoints = {host_and_port(one)[1]: one for one in listen if wants_datagrams(one)}
        self._waiting: dict[int, int] = {}
        self._looks: dict[int, int] = {}
        self._look_at = 0.0
        self.stuck: set[str] = set()
        """Endpoints whose datagrams are not read any more."""

    def turn(self) -> None:
        """Look, once per second."""
        now = time.monotonic()
        if self._endpoints and now >= self._look_at:
            self._look_at = now + LOOK_SECONDS
            self.look()

    def look(self) -> None:
        """Look at once."""
        waiting = self._bytes_waiting()
        for port, endpoint in self._endpoints.items():
            count, before = waiting.get(port, 0), self._waiting.get(port, 0)
            self._looks[port] = self._looks.get(port, 0) + 1 if count and count >= before else 0
            if self._looks[port] >= LOOKS and endpoint not in self.stuck:
                self.stuck.add(endpoint)
                log.warning(
                    "datagrams to %s are not read any more (broken ones can do that to Zenoh): everything goes over "
                    "tcp alone until this program is started again",
                    endpoint,
                )
        self._waiting = waiting

    def _bytes_waiting(self) -> dict[int, int]:
        """By port."""
        found: dict[int, int] = {}
        for table in self._tables:
            try:
                lines = table.read_text().splitlines()[1:]
            except OSError:
                continue
            for columns in map(str.split, lines):
                port = int(columns[LOCAL_ADDRESS].rpartition(":")[2], 16)
                found[port] = found.get(port, 0) + int(columns[QUEUES].rpartition(":")[2], 16)
        return found
