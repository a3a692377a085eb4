"""Hosts and ports as people write them."""

from __future__ import annotations

from kuglice.errors import NetworkError

__all__ = ["address"]


def address(text: str) -> tuple[str, int]:
    """127.0.0.1:7447 or [::1]:7447, taken apart. Raises NetworkError."""
    host, colon, port = text.rpartition(":")
    if not colon or not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise NetworkError(f"address {text!r}: must be a host and a port of 1 to 65535, like 127.0.0.1:7447")
    return host.removeprefix("[").removesuffix("]"), int(port)
