"""A direction of a link at work: its line, the loop that delivers, and what went through."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Callable, Hashable

from kuglice.lab.network.line import Line

__all__ = ["Way"]


class Way:
    """`name`: up (from clients) or down. `counter`: bytes, packets and losses, as "up tcp bytes"; shared."""

    def __init__(self, name: str, line: Line, counter: Counter[str]) -> None:
        self.line = line
        self._name = name
        self._counter = counter
        self._loop = asyncio.get_running_loop()

    @property
    def is_cut(self) -> bool:
        """Whether nothing gets through at present."""
        return self.line.is_cut(self._loop.time())

    def packet(
        self, data: bytes, deliver: Callable[[bytes], object], *, protocol: str, flow: Hashable
    ) -> None:
        """Deliver a packet when it arrives, if it does."""
        now = self._loop.time()
        arrivals = self.line.packet(now, len(data), flow)
        self._count(protocol, len(data))
        if not arrivals:
            self._counter[f"{self._name} {protocol} lost"] += 1
        for arrival in arrivals:
            if arrival <= now:
                deliver(data)
            else:
                self._loop.call_at(arrival, deliver, data)

    def stream(self, data: bytes, deliver: Callable[[bytes], object], *, flow: Hashable) -> None:
        """Deliver the next bytes of a TCP stream when they arrive; b"" for its end."""
        if data:
            self._count("tcp", len(data))
        self._loop.call_at(self.line.stream(self._loop.time(), len(data), flow), deliver, data)

    def _count(self, protocol: str, size: int) -> None:
        self._counter[f"{self._name} {protocol} bytes"] += size
        self._counter[f"{self._name} {protocol} packets"] += 1
