"""Whether the world is served already, where this server connects to: of two servers clients would hear both."""

from __future__ import annotations

from collections.abc import Sequence

from kuglice.errors import NetworkError, ProtocolError
from kuglice.protocol import Keys, Payload, Status, client_configuration, close_session, decode, open_session

__all__ = ["refuse_rival"]

LINK_SECONDS = 1.0
"""For a link to come up. Where nobody answers there is no rival either."""
ANSWER_SECONDS = 4.0
"""One that has just died is asked in vain for as long as its router takes it to be alive."""


def refuse_rival(keys: Keys, connect: Sequence[str]) -> None:
    """Raises NetworkError if another server answers for the world of `keys`. Before one answers for it oneself.

    Asked as a client asks: a server's own session lets no question to a server of that world out.
    """
    for endpoint in connect:
        _refuse_at(endpoint, keys)


def _refuse_at(endpoint: str, keys: Keys) -> None:
    try:
        session = open_session(client_configuration([endpoint], timeout=LINK_SECONDS, reconnect=False))
    except ProtocolError:
        return
    try:
        for reply in session.get(keys.status, timeout=ANSWER_SECONDS):
            if reply.ok is not None:
                raise NetworkError(
                    f"world {keys.world}: another server serves it at {endpoint} already"
                    f"{_tick(reply.ok.payload)}; end that one, or give this world another name with --world"
                )
    finally:
        close_session(session, ())


def _tick(answer: Payload) -> str:
    try:
        return f", at tick {decode(answer, Status).tick:,}"
    except ProtocolError:
        # Of another version perhaps, but it answers.
        return ""
