"""What is on its way when a link is interrupted: a stall lets it on afterwards, in order; a cut loses packets.

Regression: what had been sent before a stall came through it, and what a stall held came when that was to end at first,
though another stall had prolonged it.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Callable

from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.line import Line
from kuglice.lab.network.way import Way

SENT = [bytes([number]) for number in range(20)]
DELAYED = Conditions(round_trip=0.1)


class Sending:
    """One way, and what has come of it, with whether the line was stalled when it came."""

    def __init__(self, conditions: Conditions) -> None:
        self.line = Line(conditions, 0)
        self.counter: Counter[str] = Counter()
        self.came: list[tuple[bytes, bool]] = []
        self._loop = asyncio.get_running_loop()
        self._way = Way("up", self.line, self.counter)
        self._all = asyncio.Event()

    def packets(self) -> None:
        for data in SENT:
            self._way.packet(data, self._deliver, protocol="udp", flow=None)

    def stream(self) -> None:
        for data in SENT:
            self._way.stream(data, self._deliver, flow=None)

    def stall(self, seconds: float) -> None:
        self.line.stall(self._loop.time() + seconds)

    def cut(self, seconds: float) -> None:
        self.line.cut(self._loop.time() + seconds)

    async def all(self) -> None:
        await asyncio.wait_for(self._all.wait(), 60.0)
        assert self.came == [(data, False) for data in SENT]

    def _deliver(self, data: bytes) -> None:
        self.came.append((data, self._loop.time() < self.line.held_until))
        if len(self.came) == len(SENT):
            self._all.set()


def run(conditions: Conditions, send: Callable[[Sending], None], *orders: Callable[[Sending], None]) -> None:
    async def sent() -> None:
        sending = Sending(conditions)
        send(sending)
        for order in orders:
            order(sending)
            await asyncio.sleep(0.05)
        await sending.all()

    asyncio.run(sent())


def test_a_stall_holds_what_was_sent_before_it():
    for send in (Sending.packets, Sending.stream):
        run(DELAYED, send, lambda sending: sending.stall(0.3))


def test_a_stall_that_is_prolonged_holds_what_it_held():
    for send in (Sending.packets, Sending.stream):

        def stalled(sending: Sending, send: Callable[[Sending], None] = send) -> None:
            sending.stall(0.1)
            send(sending)

        run(Conditions(), stalled, lambda sending: sending.stall(0.4), lambda sending: sending.stall(0.01))


def test_a_cut_loses_the_packets_that_are_on_their_way():
    async def sent() -> None:
        sending = Sending(DELAYED)
        sending.packets()
        sending.cut(3600.0)
        while sending.counter["up udp lost"] < len(SENT):
            await asyncio.sleep(0.001)
        assert sending.came == []

    asyncio.run(asyncio.wait_for(sent(), 60.0))
