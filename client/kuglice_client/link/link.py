"""The client's end of the network: its session, what it subscribed to, what it says."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Iterator
from typing import TypeVar

import zenoh

from kuglice.errors import ProtocolError
from kuglice.protocol import (
    ClientInputs,
    Declared,
    Keys,
    Message,
    Part,
    Tick,
    client_configuration,
    close_session,
    decode,
    encode,
    open_links,
    stream_alone,
    wants_datagrams,
)
from kuglice_client.link.ask import Asked
from kuglice_client.link.opening import Opening
from kuglice_client.link.traffic import Traffic

__all__ = ["Link"]

log = logging.getLogger(__name__)

M = TypeVar("M", bound=Message)
Samples = zenoh.Subscriber[zenoh.handlers.Handler[zenoh.Sample]]

TICK_RING = 1024
SNAPSHOT_RING = 64


class Link:
    """Connects when made; raises JoinError if that fails until `deadline`, or when `stop` is set.

    Messages wait in rings that drop the oldest: a client that was away for long finds what is fresh, and asks
    for the rest. After a cut it does not come back by itself: whoever made it opens it anew (renewal.py, waiting.py).
    """

    def __init__(self, connect: tuple[str, ...], *, deadline: float, stop: threading.Event) -> None:
        self.endpoints = ", ".join(connect)
        self.traffic = Traffic()
        self.malformed = 0
        self.quickest_answer = math.inf
        """Seconds, of all that was asked over this session: the way there and back takes no longer."""
        self.wants_datagrams = any(map(wants_datagrams, connect))
        self.owes_datagrams = False
        """Whether this session was opened for the sake of speed without the datagrams that are wanted."""
        self._configuration = client_configuration(connect, timeout=1.0, reconnect=False)
        self._quick = client_configuration(tuple(map(stream_alone, connect)), timeout=1.0, reconnect=False)
        self.session = Opening(self._configuration).wait(deadline, stop)
        self._opening: Opening | None = None
        self._opening_owes = False
        self._declared: list[Declared] = []
        self._goodbye: _Goodbye | None = None
        self._who: tuple[str, str] | None = None
        self._ticks: Samples | None = None
        self._snapshots: Samples | None = None
        self._snapshot_ring = 0

    def listen(self, keys: Keys, *, snapshots: bool = False) -> None:
        """Subscribe to the tick stream, and to snapshots where they are wanted; from now on they are buffered."""
        self._keys = keys
        self._ticks = self._subscribe(keys.tick, TICK_RING)
        if snapshots:
            self._snapshot_ring = max(self._snapshot_ring, SNAPSHOT_RING)
            self._snapshots = self._subscribe(keys.snapshot, self._snapshot_ring)

    def show(self, name: str, session: str) -> None:
        """Let the server know that this session of the client `name` is here, until it is closed or dies."""
        self._who = (name, session)
        self._input = self.session.declare_publisher(
            self._keys.input(name, session),
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.INTERACTIVE_HIGH,
            express=True,
            reliability=zenoh.Reliability.BEST_EFFORT,
            allowed_destination=zenoh.Locality.REMOTE,
        )
        self._declared.append(self._input)
        token = self.session.liveliness().declare_token(self._keys.client(name, session))
        self._goodbye = _Goodbye(self.session, self._keys, (name, session))
        self._declared += [token, self._goodbye]

    def make_room(self, parts: int) -> None:
        """Hold at least that many parts of snapshots: fewer than one has, and none would ever be whole."""
        if self._snapshots is None or parts <= self._snapshot_ring:
            return
        self._declared.remove(self._snapshots)
        self._snapshots.undeclare()  # type: ignore[no-untyped-call]
        self._snapshot_ring = parts
        self._snapshots = self._subscribe(self._keys.snapshot, parts)

    def ticks(self) -> Iterator[Tick]:
        """Tick messages that came since the last call."""
        return self._taken(self._ticks, Tick, "ticks")

    def snapshot_parts(self) -> Iterator[Part]:
        """Parts of snapshots that came since the last call."""
        return self._taken(self._snapshots, Part, "snapshots")

    def ask(self, key: str, request: Message | None, *, timeout: float = 5.0) -> Asked:
        """Ask the server; the answer comes later, or none after `timeout` seconds."""
        return Asked(
            self.session, key, request, traffic=self.traffic, timeout=timeout, took=self._note_answer
        )

    def send(self, message: ClientInputs) -> None:
        """Put inputs on the key that `show` named; what is lost is sent again until acknowledged."""
        data = encode(message)
        self.traffic.sent["inputs"] += len(data)
        self._input.put(data)

    @property
    def kinds(self) -> list[str]:
        """What this end is connected by: `tcp`, and `udp` where ticks and inputs go as datagrams."""
        return open_links(self.session)

    def begin_renewal(self) -> None:
        """Open another session beside this one, unless that is being done already."""
        if self._opening is None:
            self._opening, self._opening_owes = Opening(self._configuration), False

    def renew_if_lost(self) -> None:
        """The same, if this session has no link any more; and at first without datagrams.

        They come up after the stream, a round trip later, and only then would it be of use. And where nobody answers
        they are waited for as long again, so that half as many tries fit into the time.
        """
        if not self.kinds and self._opening is None:
            self._opening, self._opening_owes = Opening(self._quick), self.wants_datagrams

    def renewed(self) -> bool:
        """Whether another session is open by now; then all that is said and asked goes over it, and the old one ends.

        The server sees no difference: the token is never gone.
        """
        session = None if self._opening is None else self._opening.poll(time.monotonic())
        if session is None:
            return False
        self._opening, self.owes_datagrams = None, self._opening_owes
        old, declared = self.session, [one for one in self._declared if one is not self._goodbye]
        self.session, self._declared, self._goodbye = session, [], None
        self.quickest_answer = math.inf
        if self._ticks is not None:
            self.listen(self._keys, snapshots=self._snapshots is not None)
        if self._who is not None:
            self.show(*self._who)
        close_session(old, reversed(declared), timeout=0.0)
        return True

    def close(self, timeout: float) -> bool:
        """Leave. False if Zenoh did not finish within `timeout` seconds."""
        if self._goodbye is not None:
            self._goodbye.patience = timeout / 2
        if self._opening is not None:
            self._opening.end()
        return close_session(self.session, reversed(self._declared), timeout=timeout)

    def _note_answer(self, seconds: float) -> None:
        self.quickest_answer = min(self.quickest_answer, seconds)

    def _subscribe(self, key: str, ring: int) -> Samples:
        subscriber = self.session.declare_subscriber(key, zenoh.handlers.RingChannel(ring))
        self._declared.append(subscriber)
        return subscriber

    def _taken(self, subscriber: Samples | None, kind: type[M], what: str) -> Iterator[M]:
        key = "" if subscriber is None else str(subscriber.key_expr)
        while subscriber is not None and (sample := subscriber.try_recv()) is not None:
            if str(sample.key_expr) != key:
                # Put on a wildcard, which no server does.
                continue
            self.traffic.received[what] += len(sample.payload)
            try:
                message = decode(sample.payload, kind)
            except ProtocolError as error:
                self.malformed += 1
                if self.malformed == 1:
                    log.warning("%s (further ones are only counted)", error)
                continue
            yield message


class _Goodbye:
    """Says, as the first thing that is undeclared, that the rest is no cut, and waits until it has arrived.

    A socket that is closed while more comes in takes back what it has not delivered yet. What is asked behind the
    goodbye, over the same stream, is answered after it has come.
    """

    def __init__(self, session: zenoh.Session, keys: Keys, who: tuple[str, str]) -> None:
        self._session = session
        self._keys = keys
        self._who = who
        self.patience = 0.0
        """Seconds, for a link that is lost and not known to be."""

    def undeclare(self) -> None:
        self._session.delete(
            self._keys.input(*self._who),
            congestion_control=zenoh.CongestionControl.BLOCK,
            allowed_destination=zenoh.Locality.REMOTE,
        )
        answers = self._session.get(
            self._keys.status, timeout=self.patience, congestion_control=zenoh.CongestionControl.BLOCK
        )
        # Where no link is left, the cut has been told of, and the server has noticed it too.
        if next(iter(answers), None) is None and open_links(self._session):
            log.warning(
                "the goodbye was not answered within %g s: the server may wait for %s to come back",
                self.patience,
                self._who[0],
            )
