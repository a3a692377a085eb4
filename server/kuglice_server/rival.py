"""Whether the world is served already, where this server connects to: of two servers clients would hear both."""

from __future__ import annotations

import time
from collections.abc import Sequence

import zenoh

from kuglice.errors import NetworkError, ProtocolError
from kuglice.protocol import Keys, Status, decode, open_links

__all__ = ["refuse_rival"]

LINK_SECONDS = 1.0
"""For a link to come up. One that listens does not wait for those whom it connects to."""
ANSWER_SECONDS = 4.0
"""One that has just died is asked in vain for as long as its router takes it to be alive."""
POLL_SECONDS = 0.02


def refuse_rival(session: zenoh.Session, keys: Keys, connect: Sequence[str]) -> None:
    """Raises NetworkError if another server answers for the world of `keys`. Before one answers for it oneself."""
    until = time.monotonic() + LINK_SECONDS
    while not open_links(session) and time.monotonic() < until:
        time.sleep(POLL_SECONDS)
    for reply in session.get(keys.status, timeout=ANSWER_SECONDS):
        if reply.ok is None:
            continue
        try:
            status = decode(reply.ok.payload.to_bytes(), Status)
        except ProtocolError:
            # Of another version perhaps, but it answers.
            status = None
        tick = "" if status is None else f", at tick {status.tick:,}"
        raise NetworkError(
            f"world {keys.world}: another server serves it at {', '.join(connect)} already{tick}; end that one, or "
            "give this world another name with --world"
        )
