"""What the server says unasked: every tick, and the full state now and then. Nothing here ever blocks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import zenoh

from kuglice.protocol import PART_BYTES, Ack, Keys, Stretch, StretchedTick, Tick, encode, split

__all__ = ["Publisher"]


class Publisher:
    """Puts ticks and snapshots; what a congested link cannot take is dropped, and heals at the client."""

    def __init__(self, session: zenoh.Session, keys: Keys, *, epoch: int, counters: Counter[str]) -> None:
        self._epoch = epoch
        self._counters = counters
        self._tick = session.declare_publisher(
            keys.tick,
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.INTERACTIVE_HIGH,
            express=True,
        )
        self._snapshot = session.declare_publisher(
            keys.snapshot,
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.DATA_LOW,
        )

    @property
    def declared(self) -> tuple[zenoh.Publisher, ...]:
        """For closing."""
        return (self._tick, self._snapshot)

    def tick(self, recent: Sequence[StretchedTick], acks: list[Ack]) -> None:
        """Publish the last of `recent`, and as many of those before it as fit into one batch."""
        begin = len(recent) - 1
        room = PART_BYTES - len(recent[begin].inputs) - sum(32 + len(ack.refused or "") for ack in acks)
        while begin > 0 and len(recent[begin - 1].inputs) <= room:
            begin -= 1
            room -= len(recent[begin].inputs)
        told = recent[begin:]
        message = Tick(
            epoch=self._epoch,
            first=told[0].tick,
            inputs=[entry.inputs for entry in told],
            hashes=Stretch.pack_hashes([entry.state_hash for entry in told]),
            acks=acks,
        )
        self._put(self._tick, encode(message))

    def snapshot(self, tick: int, data: bytes) -> None:
        """Publish a full state, in parts."""
        for part in split(data, of="snapshot", epoch=self._epoch, tick=tick):
            self._put(self._snapshot, encode(part))

    def _put(self, publisher: zenoh.Publisher, data: bytes) -> None:
        publisher.put(data)
        self._counters["messages out"] += 1
        self._counters["bytes out"] += len(data)
