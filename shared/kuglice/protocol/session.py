"""Zenoh sessions: no scouting, explicit endpoints, no shared memory, closed in bounded time."""

from __future__ import annotations

import ipaddress
import json
import threading
from collections.abc import Iterable, Sequence
from typing import Any, Protocol

import zenoh

from kuglice.errors import ProtocolError

__all__ = [
    "CLIENT_LEASE_MS",
    "Declared",
    "client_configuration",
    "close_session",
    "is_loopback",
    "open_session",
    "server_configuration",
]

CLIENT_LEASE_MS = 2000
"""A client that froze is noticed after this; it is the client's own lease that counts, not the server's."""

LOCAL_PROTOCOLS = ("unixsock-stream",)


class Declared(Protocol):
    """Whatever was declared on a session and can be undeclared."""

    def undeclare(self) -> object:
        """Withdraw it."""


def server_configuration(*, listen: Sequence[str], connect: Sequence[str]) -> dict[str, Any]:
    """The server is its own router (`listen`), or joins one that runs already (`connect`), or both."""
    if listen:
        return _configuration("router", listen=listen, connect=connect)
    return _configuration("client", listen=(), connect=connect)


def client_configuration(connect: Sequence[str], *, timeout: float) -> dict[str, Any]:
    """A session that connects to one of the endpoints, and gives up after `timeout` seconds."""
    return _configuration("client", listen=(), connect=connect, timeout=timeout, lease_ms=CLIENT_LEASE_MS)


def _configuration(
    mode: str,
    *,
    listen: Sequence[str],
    connect: Sequence[str],
    timeout: float = 5.0,
    lease_ms: int | None = None,
) -> dict[str, Any]:
    configuration: dict[str, Any] = {
        "mode": mode,
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        # Shared memory lost data under load, and leaves segments behind when a process is killed.
        "transport": {"shared_memory": {"enabled": False}},
    }
    if listen:
        configuration["listen"] = {"endpoints": list(listen)}
    if connect:
        configuration["connect"] = {"endpoints": list(connect), "timeout_ms": int(timeout * 1000)}
    if lease_ms is not None:
        configuration["transport"]["link"] = {"tx": {"lease": lease_ms}}
    return configuration


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
    host = host.removeprefix("[").removesuffix("]")
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def open_session(configuration: dict[str, Any]) -> zenoh.Session:
    """Open a session; raises ProtocolError, naming the endpoints, if that fails."""
    try:
        return zenoh.open(zenoh.Config.from_json5(json.dumps(configuration)))
    except zenoh.ZError as error:
        listen = configuration.get("listen", {}).get("endpoints", [])
        connect = configuration.get("connect", {}).get("endpoints", [])
        what = " and ".join(
            f"{verb} {', '.join(endpoints)}"
            for verb, endpoints in (("listen on", listen), ("connect to", connect))
            if endpoints
        )
        # Zenoh's text ends with the source line that it came from; that is of no use to a user.
        raise ProtocolError(f"cannot {what}: {str(error).partition(' at /')[0]}") from error


def close_session(session: zenoh.Session, declared: Iterable[Declared], *, timeout: float = 5.0) -> bool:
    """Undeclare, then close, within `timeout` seconds.

    False if Zenoh did not finish: the caller may still leave.
    """

    def close() -> None:
        for entity in declared:
            entity.undeclare()
        session.close()  # type: ignore[no-untyped-call]

    # Closing is known to hang on a bad link, and then nothing but a thread of its own lets us go on.
    thread = threading.Thread(target=close, name="close zenoh session", daemon=True)
    thread.start()
    thread.join(timeout)
    return not thread.is_alive()
