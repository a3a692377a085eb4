"""Where inputs arrive: a ring for each session that plays, and none for anybody else.

What a stranger sends has no subscriber and never gets here, and a flood fills the ring of who sends it and no other.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Any, NamedTuple

import zenoh

from kuglice.protocol import Keys, Payload
from kuglice_server.counters import Counters

__all__ = ["Inboxes", "Letter"]

WAITING_MESSAGES = 64
"""Of one session; the oldest gives way, since every message carries all that is unacknowledged."""

Who = tuple[str, str]
"""Name and session."""


class Letter(NamedTuple):
    """What one session said, of whatever size; None as `payload`: that it goes."""

    key: str
    payload: Payload | None


class Inboxes:
    """Of one world. For the tick loop alone."""

    def __init__(self, session: zenoh.Session, keys: Keys, *, counters: Counters) -> None:
        self._session = session
        self._keys = keys
        self._counters = counters
        self._kept: dict[Who, zenoh.Subscriber[Any]] = {}

    def keep(self, playing: Collection[Who]) -> None:
        """Have an inbox for these sessions and for nobody else."""
        for who in [known for known in self._kept if known not in playing]:
            self._kept.pop(who).undeclare()  # type: ignore[no-untyped-call]
        for who in playing:
            if who not in self._kept:
                self._kept[who] = self._session.declare_subscriber(
                    self._keys.input(*who), zenoh.handlers.RingChannel(WAITING_MESSAGES)
                )

    def take(self) -> Iterator[Letter]:
        """What came since the last call: of no session more than its ring holds, however fast it sends."""
        for who, inbox in self._kept.items():
            key = self._keys.input(*who)
            for _ in range(WAITING_MESSAGES):
                sample = inbox.try_recv()
                if sample is None:
                    break
                if str(sample.key_expr) != key:
                    # A wildcard speaks for everybody, and nobody may.
                    self._counters.add("foreign")
                    continue
                self._counters.add("messages_in")
                self._counters.add("bytes_in", len(sample.payload))
                yield Letter(key, None if sample.kind == zenoh.SampleKind.DELETE else sample.payload)

    def undeclare(self) -> None:
        """Give all of them up."""
        self.keep(())
