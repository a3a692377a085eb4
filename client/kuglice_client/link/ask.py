"""Queries to the server, asked now and answered later: the client goes on meanwhile."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import zenoh

from kuglice.errors import JoinError, ProtocolError
from kuglice.protocol import Assembly, Message, Part, Payload, Refusal, Whole, decode, decompress, encode
from kuglice_client.link.traffic import Traffic

__all__ = ["Asked"]

MAX_REPLIES = 4096
MAX_WHOLE_BYTES = 256 << 20
POLL_SECONDS = 0.001


class Asked:
    """One query under way. `took`: told the seconds until the first reply."""

    def __init__(
        self,
        session: zenoh.Session,
        key: str,
        request: Message | None,
        *,
        traffic: Traffic,
        timeout: float = 5.0,
        took: Callable[[float], object] = lambda seconds: None,
    ) -> None:
        self.refused = False
        """Whether it is the server that said no, and not the network."""
        self._key = key
        self._traffic = traffic
        self._took = took
        self._asked_at = time.monotonic()
        self._replies: list[Payload] = []
        self._handler: Any = session.get(
            key,
            zenoh.handlers.FifoChannel(MAX_REPLIES),
            # Parts come under one key, and only without consolidation do all of them arrive.
            consolidation=zenoh.ConsolidationMode.NONE,
            timeout=timeout,
            payload=None if request is None else encode(request),
            congestion_control=zenoh.CongestionControl.BLOCK,
        )

    def poll(self) -> list[Payload] | None:
        """All replies once the last one is there, None before.

        Raises JoinError if refused or not answered.
        """
        while True:
            try:
                reply = self._handler.try_recv()
            except zenoh.ZError:  # the channel is closed: that was all
                if not self._replies:
                    raise JoinError(f"nobody answers {self._key}") from None
                return self._replies
            if reply is None:
                return None
            if reply.err is not None:
                self.refused, reason = _reason(reply.err.payload)
                raise JoinError(f"{self._key}: {reason}")
            if not self._replies:
                self._took(time.monotonic() - self._asked_at)
            payload = reply.ok.payload
            self._traffic.received["joining"] += len(payload)
            self._replies.append(payload)

    def wait(self, stop: threading.Event) -> list[Payload]:
        """The replies, waited for. Raises JoinError, also when `stop` is set meanwhile."""
        while (replies := self.poll()) is None:
            if stop.wait(POLL_SECONDS):
                raise JoinError(f"{self._key}: stopped while asking")
        return replies

    def poll_whole(self) -> Whole | None:
        """As `poll`, with the parts put together. Raises JoinError if some are missing."""
        replies = self.poll()
        return None if replies is None else self._assembled(replies)

    def wait_whole(self, stop: threading.Event) -> Whole:
        """As `wait`, with the parts put together. Raises JoinError if some are missing."""
        return self._assembled(self.wait(stop))

    def _assembled(self, replies: list[Payload]) -> Whole:
        assembly = Assembly()
        try:
            for reply in replies:
                whole = assembly.add(decode(reply, Part))
                if whole is not None:
                    return whole._replace(data=decompress(whole.data, max_bytes=MAX_WHOLE_BYTES))
        except ProtocolError as error:
            raise JoinError(f"{self._key}: {error}") from error
        raise JoinError(f"{self._key}: {len(replies)} parts came, and some are missing")


def _reason(payload: Payload) -> tuple[bool, str]:
    try:
        return True, decode(payload, Refusal).reason
    except ProtocolError:
        if len(payload) > Refusal.max_bytes:
            return False, f"an error of {len(payload)} bytes, at most {Refusal.max_bytes} allowed"
        # Zenoh's own errors, a timeout for one, are plain text.
        return False, bytes(payload)[:200].decode("utf-8", "replace")
