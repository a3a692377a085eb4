"""What the server says unasked: every tick, and the full state now and then. Nothing here ever blocks.

Ticks go best-effort, over a link of datagrams to those who have one, else like everything else. Snapshots go over the
stream: they come in many parts, all of which are needed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import zenoh

from kuglice.protocol import PART_BYTES, Ack, Keys, StretchedTick, Tick, encode, split
from kuglice_server.counters import Counters
from kuglice_server.repeats import Repeats

__all__ = ["Publisher"]

ENVELOPE_BYTES = 17
"""Of a tick message that has nothing to say but its hash."""
EARLY_BYTES = 1
"""What an outcome takes that goes with the input itself."""


class Publisher:
    """Puts ticks and snapshots; what a congested link cannot take is dropped, and heals at the client."""

    def __init__(
        self, session: zenoh.Session, keys: Keys, *, epoch: int, rate: float, counters: Counters
    ) -> None:
        self._epoch = epoch
        self._counters = counters
        self._repeats = Repeats(rate)
        self._tick = session.declare_publisher(
            keys.tick,
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.INTERACTIVE_HIGH,
            express=True,
            reliability=zenoh.Reliability.BEST_EFFORT,
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

    def tick(self, recent: Sequence[StretchedTick], acks: Sequence[Ack], heard: Iterable[int] = ()) -> None:
        """Publish the last of `recent`, and as many of those before it as are worth it (repeats.py).

        `heard`: for each client the first tick that it misses.
        """
        data = encode(self.message(recent, acks, heard))
        self._repeats.spent(len(data))
        self._put(self._tick, data)

    def message(self, recent: Sequence[StretchedTick], acks: Sequence[Ack], heard: Iterable[int]) -> Tick:
        """What `tick` publishes."""
        newest = recent[-1]
        acks = _fitting(acks, PART_BYTES - len(newest.inputs))
        rest = ENVELOPE_BYTES + sum(EARLY_BYTES if ack.tick == newest.tick else ack.size for ack in acks)
        count = self._repeats.choose(recent, heard, rest=rest)
        return Tick.of(self._epoch, recent[-count:], acks)

    def snapshot(self, tick: int, data: bytes) -> None:
        """Publish a full state, in parts, if anybody listens: players do not, they ask for the one they need."""
        # The stub says bool.
        if not self._snapshot.matching_status.matching:  # type: ignore[attr-defined]
            return
        self._counters.add("snapshots_out")
        for part in split(data, of="snapshot", epoch=self._epoch, tick=tick):
            self._put(self._snapshot, encode(part))

    def _put(self, publisher: zenoh.Publisher, data: bytes) -> None:
        publisher.put(data)
        self._counters.add("messages_out")
        self._counters.add("bytes_out", len(data))


def _fitting(acks: Sequence[Ack], room: int) -> list[Ack]:
    """As many as fit, newest first; who does not hear of an outcome asks again."""
    taken: list[Ack] = []
    for ack in reversed(acks):
        room -= ack.size
        if room < 0:
            break
        taken.append(ack)
    return taken[::-1]
