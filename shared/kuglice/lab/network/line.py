"""One direction of a link: when, and how often, each packet arrives. Pure: time comes in, times go out."""

from __future__ import annotations

import math
import random
from collections.abc import Hashable

from kuglice.lab.network.conditions import Conditions

__all__ = ["SEGMENT_BYTES", "Line"]

SEGMENT_BYTES = 1448
"""Of payload in a TCP segment on a link with an MTU of 1500."""
FAST_RETRANSMIT_SECONDS = 0.05
"""Until three later packets of a 60 Hz stream have told the sender that one is missing."""

REMEMBERED_FLOWS = 4096


class Line:
    """`direction` (0 or 1) tells the two random streams of a link apart.

    A `flow` is what one end of a TCP connection, or one UDP socket, sends: within it packets keep their order,
    unless the conditions say otherwise; one flow never holds another back, but for the bandwidth, which they share.
    """

    def __init__(self, conditions: Conditions, direction: int) -> None:
        self._direction = direction
        self._last: dict[Hashable, float] = {}
        self._free = -math.inf
        self._cut_until = -math.inf
        self.held_until = -math.inf
        """End of the last stall."""
        self.change(conditions)

    def change(self, conditions: Conditions) -> None:
        """Other conditions from now on; their random stream begins anew."""
        self.conditions = conditions
        self._random = random.Random(2 * conditions.seed + self._direction)

    def cut(self, until: float) -> None:
        """Lose every packet until then, or until the end of a cut that lasts longer."""
        self._cut_until = max(self._cut_until, until)

    def mend(self) -> None:
        """No longer cut, whatever was ordered."""
        self._cut_until = -math.inf

    def stall(self, until: float) -> None:
        """Hold every packet until then, or until the end of a stall that lasts longer, and lose none."""
        self.held_until = max(self.held_until, until)

    def is_cut(self, now: float) -> bool:
        """Whether packets are lost now because the line is cut."""
        return now < self._cut_until

    def packet(self, now: float, size: int, flow: Hashable = None) -> tuple[float, ...]:
        """Arrival times of a packet of `size` bytes sent `now`: none if it is lost, two if it is doubled."""
        conditions = self.conditions
        # Three draws per packet, whatever becomes of it, so that its fate depends on its number alone.
        lost, doubled, early = (self._random.random() for _ in range(3))
        if self.is_cut(now) or lost < conditions.loss:
            return ()
        arrival = self._arrival(now, size, early)
        if not conditions.reorder:
            arrival = self._in_order(arrival, flow, now)
        return (arrival, self._in_order(arrival, flow, now)) if doubled < conditions.duplicate else (arrival,)

    def stream(self, now: float, size: int, flow: Hashable = None) -> float:
        """Arrival time of bytes of a TCP stream.

        A lost segment comes when it has been sent again, and what follows waits for it.
        """
        lost, _, early = (self._random.random() for _ in range(3))
        arrival = self._arrival(now, size, early)
        segments = max(1, math.ceil(size / SEGMENT_BYTES))
        if lost < 1.0 - (1.0 - self.conditions.loss) ** segments:
            arrival += self.conditions.round_trip + FAST_RETRANSMIT_SECONDS
        return self._in_order(arrival, flow, now)

    def _arrival(self, now: float, size: int, early: float) -> float:
        conditions = self.conditions
        leaves = max(now, self.held_until)
        if conditions.bandwidth:
            leaves = max(leaves, self._free) + size / conditions.bandwidth
            self._free = leaves
        return leaves + 0.5 * conditions.round_trip * (1.0 + conditions.jitter * (2.0 * early - 1.0))

    def _in_order(self, arrival: float, flow: Hashable, now: float) -> float:
        # Strictly later, so that a timer that sorts by time keeps the order too.
        arrival = max(arrival, math.nextafter(self._last.get(flow, -math.inf), math.inf))
        if len(self._last) >= REMEMBERED_FLOWS:
            self._last = {flow: last for flow, last in self._last.items() if last > now}
        self._last[flow] = arrival
        return arrival
