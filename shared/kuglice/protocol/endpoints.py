"""Where a session listens or connects: `tcp/host:port`, and `tcp+udp/host:port` for datagrams beside it."""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Iterable

from kuglice.errors import ProtocolError

__all__ = [
    "DEFAULT_ENDPOINT",
    "as_written",
    "check_endpoints",
    "check_hosts",
    "host_and_port",
    "is_loopback",
    "locators",
    "stream_alone",
    "unresolved",
    "wants_datagrams",
]

DEFAULT_ENDPOINT = "tcp+udp/127.0.0.1:7447"
BOTH = "tcp+udp"
LOCAL_PROTOCOLS = ("unixsock-stream",)
STREAM, DATAGRAMS = "?rel=1", "?rel=0"
PROTOCOLS = ("tcp", BOTH, "udp", "tls", "quic", "ws", *LOCAL_PROTOCOLS)


def locators(endpoint: str) -> list[str]:
    """The endpoint as Zenoh writes it: with datagrams, it is two links to one place.

    The one carries what must arrive, the other what may be lost.
    """
    protocol, _, rest = endpoint.partition("/")
    if protocol != BOTH:
        return [endpoint]
    return [f"tcp/{rest}{STREAM}", f"udp/{rest}{DATAGRAMS}"]


def as_written(links: Iterable[str]) -> list[str]:
    """The endpoints that `locators` made these of: what a user wrote, and can be told."""
    return [
        f"{BOTH}/{link.removeprefix('tcp/').removesuffix(STREAM)}" if link.endswith(STREAM) else link
        for link in links
        if not link.endswith(DATAGRAMS)
    ]


def wants_datagrams(endpoint: str) -> bool:
    """Whether it asks for datagrams beside the stream."""
    return endpoint.partition("/")[0] == BOTH


def stream_alone(endpoint: str) -> str:
    """The same place without the datagrams that it may ask for."""
    return f"tcp/{endpoint.partition('/')[2]}" if wants_datagrams(endpoint) else endpoint


def check_endpoints(endpoints: Iterable[str]) -> None:
    """Raises ProtocolError for the first that is none: nobody need wait until nothing answers there."""
    for endpoint in endpoints:
        is_loopback(endpoint)


def check_hosts(endpoints: Iterable[str]) -> None:
    """Raises ProtocolError for the first whose host is a name without an address; asks, and may wait for the answer.

    Whoever listens would try to connect to it for ever, and without a word.
    """
    for endpoint in endpoints:
        host = unresolved(endpoint)
        if host is not None:
            raise ProtocolError(f"endpoint {endpoint!r}: no address is known of a host {host}")


def host_and_port(endpoint: str) -> tuple[str, int]:
    """Of an endpoint by name and port: `tcp/[::1]:7447` -> `::1`, 7447. Raises ProtocolError if it is none."""
    protocol, slash, rest = endpoint.partition("/")
    if not slash or not protocol or not rest:
        raise ProtocolError(
            f"endpoint {endpoint!r}: must look like {DEFAULT_ENDPOINT}, or tcp/127.0.0.1:7447"
        )
    if protocol not in PROTOCOLS:
        raise ProtocolError(f"endpoint {endpoint!r}: {protocol!r} must be one of {', '.join(PROTOCOLS)}")
    address = rest.partition("?")[0].partition("#")[0]
    host, colon, port = address.rpartition(":")
    if not colon or not host or not port.isdecimal() or int(port) > 65535:
        raise ProtocolError(f"endpoint {endpoint!r}: must have a host, and end with a port of 0 to 65535")
    if protocol == BOTH and address != rest:
        raise ProtocolError(f"endpoint {endpoint!r}: takes no parameters")
    return host.removeprefix("[").removesuffix("]"), int(port)


def is_loopback(endpoint: str) -> bool:
    """Whether nobody but this machine can reach `endpoint`; raises ProtocolError if it is none."""
    protocol, _, rest = endpoint.partition("/")
    if protocol in LOCAL_PROTOCOLS and rest:
        return True
    host, _ = host_and_port(endpoint)
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def unresolved(endpoint: str) -> str | None:
    """The host of `endpoint` if it is a name that nobody knows an address of; asks, and may wait for the answer."""
    if endpoint.partition("/")[0] in LOCAL_PROTOCOLS:
        return None
    host, port = host_and_port(endpoint)
    try:
        socket.getaddrinfo(host, port)
    except (OSError, UnicodeError):
        return host
    return None
