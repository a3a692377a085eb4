"""Zenoh sessions: no scouting, explicit endpoints, no shared memory, closed in bounded time."""

from __future__ import annotations

import json
import logging
import os
import re
from collections.abc import Iterable, Sequence
from typing import Any, Protocol

import zenoh

from kuglice.aside import aside
from kuglice.errors import ProtocolError
from kuglice.protocol.access import access_control
from kuglice.protocol.endpoints import DATAGRAMS, as_written, locators, unresolved
from kuglice.protocol.keys import Keys
from kuglice.protocol.messages.envelope import MAX_WHOLE_BYTES

__all__ = [
    "LEASE_MS",
    "Declared",
    "client_configuration",
    "close_session",
    "lacks_stream",
    "nobody_answers",
    "open_links",
    "open_session",
    "server_configuration",
]

log = logging.getLogger(__name__)

LEASE_MS = 2000
"""One that froze, or a link that is dead, is noticed after this by the other end: each one's own lease counts."""

LINKS = 2
"""Between two sessions: a stream, and datagrams beside it."""
OPEN_TIMEOUT_MS = 1500
"""How long a link that nobody answers on is tried: it may have been cut, or another one be there."""
RETRY_MS = 200
RECEIVING_THREADS = 32
"""A session that ends keeps one of the threads that receive for a round trip. By default there are two of them, and
with both taken nobody's datagrams are read."""
ACCEPTING_THREADS = 64
"""A socket that is closed before what was said into it has been acknowledged keeps one of the threads that accept for
ten seconds: of a client whose link is cut while it connects, or of a stranger who greets and vanishes. By default there
is one.
"""
LINK_THREADS = 32
"""Sessions that end keep these in the same way, and these are who lets new links in. By default there is one; while it
waits nobody can join, and a second datagram over a link that is not in yet stops the reading of all datagrams.
"""
MAX_MESSAGE_BYTES = MAX_WHOLE_BYTES + (64 << 10)
"""Of one that comes in, key and envelope included. Zenoh by itself puts together up to 1 GiB, and a ring keeps that
many times over. No state needs more, be there ever so many balls: whatever grows with them comes in parts of a batch
each. A larger one is dropped piece by piece as it comes, untold, and its link goes on.
"""
THREADS = (
    f"(rx: (worker_threads: {RECEIVING_THREADS}), acc: (worker_threads: {ACCEPTING_THREADS}), "
    f"net: (worker_threads: {LINK_THREADS}))"
)
RUNTIME = "ZENOH_RUNTIME"
"""Read by Zenoh when the first session of a process is opened; what the user says there counts."""
NEVER_MS = 24 * 3600 * 1000


class Declared(Protocol):
    """Whatever was declared on a session and can be undeclared."""

    def undeclare(self) -> object:
        """Withdraw it."""


def server_configuration(
    *, listen: Sequence[str], connect: Sequence[str], keys: Keys | None = None
) -> dict[str, Any]:
    """The server is its own router (`listen`), or joins one that runs already (`connect`), or both.

    `keys`: of the world that it serves, None for what only passes on (access.py).
    """
    made = (
        # A link that is dead is to be noticed at the other end too, and soon.
        _configuration("router", listen=listen, connect=connect, lease_ms=LEASE_MS)
        if listen
        else _configuration("client", listen=(), connect=connect)
    )
    if keys is not None:
        made["access_control"] = access_control(keys)
        # It lists whatever is declared.
        made["adminspace"] = {"enabled": False}
    return made


def client_configuration(connect: Sequence[str], *, timeout: float, reconnect: bool = True) -> dict[str, Any]:
    """A session that connects to one of the endpoints, and gives up after `timeout` seconds.

    Where datagrams are wanted too (tcp+udp/...), it is content with the stream if they do not get through.
    `reconnect`: whether it comes back by itself after a cut. With datagrams it then numbers its keys anew, and
    datagrams that are on their way or come first are taken for messages of other keys; without datagrams all is well.
    A session that does not is opened at once or not at all, whatever `timeout` says.
    """
    made = _configuration("client", listen=(), connect=connect, timeout=timeout, lease_ms=LEASE_MS)
    if not reconnect:
        made["connect"]["timeout_ms"] = 0
        made["connect"]["retry"] |= {"period_init_ms": NEVER_MS, "period_max_ms": NEVER_MS}
    return made


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
        "transport": {
            "shared_memory": {"enabled": False},
            "unicast": {"max_links": LINKS},
            "link": {"rx": {"max_message_size": MAX_MESSAGE_BYTES}},
        },
    }
    if listen:
        configuration["listen"] = {"endpoints": [one for endpoint in listen for one in locators(endpoint)]}
    if connect:
        targets = [locators(endpoint) for endpoint in connect]
        configuration["connect"] = {
            "endpoints": [
                target[0] if len(target) == 1 else {"strategy": "allOf", "locators": target}
                for target in targets
            ],
            "timeout_ms": int(timeout * 1000),
            # A link that was cut is back when it is back: waiting longer and longer for it helps nobody.
            "retry": {"period_init_ms": RETRY_MS, "period_max_ms": RETRY_MS, "period_increase_factor": 1.0},
        }
        configuration["transport"]["unicast"]["open_timeout"] = OPEN_TIMEOUT_MS
        if mode == "client" and any(len(target) > 1 for target in targets):
            # With any other timeout Zenoh wants all links or none; so it goes on with the one it gets, at once.
            configuration["connect"]["timeout_ms"] = 0
    if lease_ms is not None:
        configuration["transport"]["link"]["tx"] = {"lease": lease_ms}
    return configuration


def open_session(configuration: dict[str, Any]) -> zenoh.Session:
    """Open a session; raises ProtocolError, naming the endpoints, if that fails."""
    os.environ.setdefault(RUNTIME, THREADS)
    try:
        return zenoh.open(zenoh.Config.from_json5(json.dumps(configuration)))
    except zenoh.ZError as error:
        raise ProtocolError(_why_not(configuration, str(error))) from error


def _why_not(configuration: dict[str, Any], told: str) -> str:
    """What a user can do about it. Zenoh tells of its locators, its source lines, and of timeouts."""
    listen = configuration.get("listen", {}).get("endpoints", [])
    # One that listens waits for those it connects to: if it is given up, it is for an address of its own.
    if listen:
        number = re.search(r"os error (\d+)", told)
        reason = os.strerror(int(number[1])).lower() if number else told.partition(" at /")[0]
        hint = "; end the program that has it, or --listen elsewhere" if "in use" in reason else ""
        return f"cannot listen on {', '.join(as_written(listen))}: {reason}{hint}"
    return nobody_answers(configuration)


def nobody_answers(configuration: dict[str, Any]) -> str:
    """What to tell a user who connects to where nobody answers."""
    connect = configuration.get("connect", {}).get("endpoints", [])
    endpoints = [name for endpoint in connect for name in as_written(_links(endpoint))]
    where = ", ".join(endpoints)
    unknown = [host for host in map(unresolved, endpoints) if host is not None]
    if unknown:
        return f"cannot connect to {where}: no address is known of a host {' or '.join(unknown)}"
    return (
        f"cannot connect to {where}: nobody answers there; start a server there (`kuglice server SCENE`), or say "
        "with --connect where one, or a router, runs"
    )


def _links(endpoint: str | dict[str, Any]) -> list[str]:
    return [endpoint] if isinstance(endpoint, str) else endpoint["locators"]


def open_links(session: zenoh.Session) -> list[str]:
    """The kinds of links that are up, like `tcp` or `udp`, each once, in order of the alphabet."""
    return sorted({str(link.dst).partition("/")[0] for link in session.info.links()})


def lacks_stream(session: zenoh.Session) -> bool:
    """Whether of a stream and the datagrams beside it only the datagrams came up: questions may get lost there."""
    kinds = [str(link.dst).endswith(DATAGRAMS) for link in session.info.links()]
    return bool(kinds) and all(kinds)


def close_session(session: zenoh.Session, declared: Iterable[Declared], *, timeout: float = 5.0) -> bool:
    """Undeclare, then close, within `timeout` seconds.

    False if Zenoh did not finish: the caller may still leave.
    """

    def close() -> None:
        for end in (*(entity.undeclare for entity in declared), session.close):
            try:
                end()  # type: ignore[no-untyped-call]
            except zenoh.ZError as error:
                # Where the link is lost there is nobody to withdraw it from; the session is to be closed all the same.
                log.debug("%s", error)

    # Closing is known to hang on a bad link, and then nothing but a thread of its own lets us go on.
    thread = aside(close, "close zenoh session")
    thread.join(timeout)
    return not thread.is_alive()
