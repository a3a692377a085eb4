"""Where a session listens or connects: `tcp/host:port`, and `tcp+udp/host:port` for datagrams beside it."""

from __future__ import annotations

import ipaddress

from kuglice.errors import ProtocolError

__all__ = ["DEFAULT_ENDPOINT", "is_loopback", "locators", "wants_datagrams"]

DEFAULT_ENDPOINT = "tcp+udp/127.0.0.1:7447"
BOTH = "tcp+udp"
LOCAL_PROTOCOLS = ("unixsock-stream",)


def locators(endpoint: str) -> list[str]:
    """The endpoint as Zenoh writes it: with datagrams, it is two links to one place.

    The one carries what must arrive, the other what may be lost.
    """
    protocol, _, rest = endpoint.partition("/")
    if protocol != BOTH:
        return [endpoint]
    return [f"tcp/{rest}?rel=1", f"udp/{rest}?rel=0"]


def wants_datagrams(endpoint: str) -> bool:
    """Whether it asks for datagrams beside the stream."""
    return endpoint.partition("/")[0] == BOTH


def is_loopback(endpoint: str) -> bool:
    """Whether nobody but this machine can reach `endpoint`; raises ProtocolError if it is none."""
    protocol, slash, rest = endpoint.partition("/")
    if not slash or not protocol or not rest:
        raise ProtocolError(f"endpoint {endpoint!r}: must look like tcp/127.0.0.1:7447")
    if protocol in LOCAL_PROTOCOLS:
        return True
    address = rest.partition("?")[0].partition("#")[0]
    host, colon, port = address.rpartition(":")
    if not colon or not port.isdecimal() or int(port) > 65535:
        raise ProtocolError(f"endpoint {endpoint!r}: must end with a port of 0 to 65535")
    if protocol == BOTH and address != rest:
        raise ProtocolError(f"endpoint {endpoint!r}: takes no parameters")
    host = host.removeprefix("[").removesuffix("]")
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
