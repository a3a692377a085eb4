"""Regions as they are published: the balls of each node that somebody looks at, and who plays and holds what.

Nodes that nobody looks at are neither packed nor put. An empty node is told when it becomes empty and then once a
second, so that a message that was lost leaves no ball behind for long. At pace p a node is told every 2^p-th time;
its number says at which of those, so that they do not all fall into one tick.

The tick only finds out who looks, and packs: encoding and putting go on in a thread beside it, for a copy for each of
many views takes longer than a tick may wait. If that is not done with the last round when the next is due, the next is
left out: the one after it is newer.

They go over the stream, and are dropped where it cannot take them. All that is due at once goes out in large batches;
as a datagram such a batch would be lost with any of its packets. Each message as a datagram of its own was tried: at
150 ms, 20 % jitter and 2 % loss a view glides over 0.012 radii instead of 0.018 on average, but 128 views over the
stream then cost 29 % of a core instead of 15, and miss messages.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, Future

import zenoh

from kuglice import World
from kuglice.errors import ProtocolError
from kuglice.protocol import Holding, Keys, Region, RegionTerms, encode
from kuglice_server.counters import Counters
from kuglice_server.regions.audience import Audience
from kuglice_server.regions.watch import Watch, Watched

__all__ = ["RegionPublisher"]

log = logging.getLogger(__name__)

EMPTY = b"\0"
SAID_AGAIN_SECONDS = 1.0


class RegionPublisher:
    """`every`: ticks between two messages about one node at pace 0. `teller`: runs what goes on beside the tick, one
    thing at a time; whoever made it shuts it down before the session is closed. Not for two threads at once.
    `watch` and `hearing`: who listens to nodes and to who plays, as far as the session has said so.
    """

    def __init__(
        self,
        session: zenoh.Session,
        keys: Keys,
        terms: RegionTerms,
        *,
        epoch: int,
        world: World,
        every: int,
        counters: Counters,
        teller: Executor,
    ) -> None:
        self._epoch = epoch
        self._every = every
        self._again = max(1, round(SAID_AGAIN_SECONDS * terms.rate))
        self._counters = counters
        self._teller = teller
        self._told: Future[None] | None = None
        self._round: int | None = None
        self._packer = terms.packer(world.scene.box)
        self.watch = Watch(session, keys, terms.depth)
        self._holding = session.declare_publisher(
            keys.holding,
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.DATA,
        )
        self.hearing = Audience(self._holding)
        self._held: tuple[object, object] | None = None
        self._held_at = 0
        self._told_empty: dict[tuple[int, int], int] = {}

    @property
    def publishers(self) -> int:
        """How many are declared for regions."""
        return self.watch.publishers

    @property
    def declared(self) -> tuple[zenoh.Publisher, ...]:
        """For closing."""
        return (self._holding, *self.watch.declared)

    def turn(self, world: World) -> None:
        """Publish what is due in the state that `world` is in. Never blocks, and raises nothing but bugs."""
        if world.tick % self._every:
            return
        try:
            self._publish(world, world.tick // self._every)
        except zenoh.ZError as error:
            self._not_published(error)

    def _publish(self, world: World, turn: int) -> None:
        self._tell_holding(world, turn)
        if self._told is not None:
            if not self._told.done():
                self._counters.add("region_rounds_left_out")
                return
            # What went wrong beside the tick goes wrong here.
            self._told.result()
        watched = self.watch.looked_at()
        # Since the last round, and not in this turn: rounds that are left out may all be of the same kind.
        last, self._round = turn - 1 if self._round is None else self._round, turn
        due = [one for one in watched if (turn + one.node) >> one.pace != (last + one.node) >> one.pace]
        if due:
            self._tell(world, due, turn)
        if self._told_empty:
            here = {(one.pace, one.node) for one in watched}
            self._told_empty = {key: at for key, at in self._told_empty.items() if key in here}

    def _tell(self, world: World, due: list[Watched], turn: int) -> None:
        nodes = sorted({one.node for one in due})
        packed, left_out = world.regions(self._packer, nodes)
        self._counters.add("balls_not_told", left_out)
        balls = dict(zip(nodes, packed, strict=True))
        worth = [one for one in due if self._worth_telling(one, balls[one.node], turn)]
        self._told = self._teller.submit(self._put_all, world.tick, worth, balls)

    def _put_all(self, tick: int, worth: Sequence[Watched], balls: Mapping[int, bytes]) -> None:
        """In the thread of the teller."""
        encoded: dict[int, bytes | None] = {}
        for one in worth:
            if one.node not in encoded:
                encoded[one.node] = self._encoded(tick, one.node, balls[one.node])
            data = encoded[one.node]
            if data is not None:
                self._put(one.publisher, data)

    def _worth_telling(self, one: Watched, balls: bytes, turn: int) -> bool:
        key = (one.pace, one.node)
        if balls != EMPTY:
            self._told_empty.pop(key, None)
            return True
        if turn - self._told_empty.get(key, turn - self._again) < self._again:
            return False
        self._told_empty[key] = turn
        return True

    def _encoded(self, tick: int, node: int, balls: bytes) -> bytes | None:
        try:
            # Ours, and many at once: there is nothing to validate.
            message = Region.model_construct(epoch=self._epoch, tick=tick, node=node, balls=balls)
            return encode(message)
        except ProtocolError as error:
            if not self._counters["regions_too_large"]:
                log.error("region %d is not told: %s", node, error)
            self._counters.add("regions_too_large")
            return None

    def _tell_holding(self, world: World, turn: int) -> None:
        if not self.hearing.present():
            return
        now = (world.players, world.held)
        if now == self._held and turn - self._held_at < self._again:
            return
        self._held, self._held_at = now, turn
        self._put(
            self._holding,
            encode(Holding.of(self._epoch, world)),
        )

    def _put(self, publisher: zenoh.Publisher, data: bytes) -> None:
        try:
            publisher.put(data)
        except zenoh.ZError as error:
            self._not_published(error)
            return
        self._counters.add("regions_out")
        self._counters.add("region_bytes_out", len(data))

    def _not_published(self, error: zenoh.ZError) -> None:
        if not self._counters["regions_unpublished"]:
            log.error("a region cannot be published: %s", error)
        self._counters.add("regions_unpublished")
