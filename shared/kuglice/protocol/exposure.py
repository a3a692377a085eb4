"""Who may listen where others can reach it."""

from __future__ import annotations

from collections.abc import Iterable

from kuglice.errors import ProtocolError
from kuglice.protocol.endpoints import is_loopback

__all__ = ["refuse_exposed"]


def refuse_exposed(listen: Iterable[str]) -> None:
    """Raises ProtocolError for the first endpoint that is not on loopback alone."""
    for endpoint in listen:
        if not is_loopback(endpoint):
            raise ProtocolError(
                f"endpoint {endpoint!r}: others can reach it, and there are no accounts and no "
                "encryption yet; say --insecure if that is what you want"
            )
