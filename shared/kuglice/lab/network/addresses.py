"""Hosts and ports as people write them."""

from __future__ import annotations

from kuglice.errors import NetworkError, ProtocolError
from kuglice.protocol import host_and_port

__all__ = ["address"]


def address(text: str) -> tuple[str, int]:
    """An endpoint, as other commands take it, or 127.0.0.1:7447 alone, taken apart. Raises NetworkError."""
    try:
        host, port = host_and_port(text if "/" in text else f"tcp+udp/{text}")
        if port:
            return host, port
    except ProtocolError:
        pass
    raise NetworkError(
        f"address {text!r}: must be a host and a port of 1 to 65535, like tcp+udp/127.0.0.1:7447"
    )
