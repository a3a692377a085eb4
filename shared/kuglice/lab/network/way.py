"""A direction of a link at work: its line, the loop that delivers, and what went through."""

from __future__ import annotations

import asyncio
from collections import Counter, deque
from collections.abc import Callable, Hashable
from functools import partial

from kuglice.lab.network.line import Line

__all__ = ["Way"]


class Way:
    """`name`: up (from clients) or down. `counter`: bytes, packets and losses, as "up tcp bytes"; shared."""

    def __init__(self, name: str, line: Line, counter: Counter[str]) -> None:
        self.line = line
        self._name = name
        self._counter = counter
        self._loop = asyncio.get_running_loop()
        self._held: deque[Callable[[], object]] = deque()

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
            self._lose(protocol)
        arrive = partial(self._arrive, partial(self._hand_over, data, deliver, protocol))
        for arrival in arrivals:
            if arrival <= now:
                arrive()
            else:
                self._loop.call_at(arrival, arrive)

    def stream(self, data: bytes, deliver: Callable[[bytes], object], *, flow: Hashable) -> None:
        """Deliver the next bytes of a TCP stream when they arrive; b"" for its end."""
        if data:
            self._count("tcp", len(data))
        arrival = self.line.stream(self._loop.time(), len(data), flow)
        self._loop.call_at(arrival, self._arrive, partial(deliver, data))

    def _arrive(self, hand_over: Callable[[], object]) -> None:
        # The line knew of stalls that had begun when this was sent, and not of those since, nor that one is prolonged.
        self._held.append(hand_over)
        self._let_on()

    def _let_on(self) -> None:
        """What has arrived, in order, unless there is a stall."""
        while self._held:
            if self._loop.time() < self.line.held_until:
                self._loop.call_at(self.line.held_until, self._let_on)
                return
            self._held.popleft()()

    def _hand_over(self, data: bytes, deliver: Callable[[bytes], object], protocol: str) -> None:
        if self.is_cut:
            self._lose(protocol)
        else:
            deliver(data)

    def _lose(self, protocol: str) -> None:
        self._counter[f"{self._name} {protocol} lost"] += 1

    def _count(self, protocol: str, size: int) -> None:
        self._counter[f"{self._name} {protocol} bytes"] += size
        self._counter[f"{self._name} {protocol} packets"] += 1
