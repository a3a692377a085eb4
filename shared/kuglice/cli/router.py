"""`kuglice router`: pass a world on, so that its server feeds one neighbour instead of many clients."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import typer
import zenoh

from kuglice.cli.logs import STDERR, log_to_stderr
from kuglice.cli.stop import stop_on_signals
from kuglice.errors import NetworkError, ProtocolError
from kuglice.protocol import (
    UnreadDatagrams,
    check_endpoints,
    check_hosts,
    client_configuration,
    close_session,
    open_session,
    refuse_exposed,
    server_configuration,
)

__all__ = ["register"]

LOOK_SECONDS = 1.0


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("router")(router)


def router(
    *,
    connect: Annotated[
        list[str] | None,
        typer.Option(help="Endpoint of the server, or of another router. [default: tcp/127.0.0.1:7447]"),
    ] = None,
    listen: Annotated[
        list[str] | None, typer.Option(help="Endpoint for clients. [default: tcp/127.0.0.1:7448]")
    ] = None,
    insecure: Annotated[
        bool, typer.Option("--insecure", help="Allow listening on addresses that others can reach.")
    ] = False,
) -> None:
    """Pass a server's worlds on to clients of its own.

    The server sends everything once, however many clients are behind the router. A server that is not there
    yet, or away, is waited for. Ends on SIGINT or SIGTERM.

    Example: kuglice router --listen tcp/127.0.0.1:7448
    """
    log_to_stderr()
    stop = stop_on_signals()
    ours = tuple(listen or ("tcp/127.0.0.1:7448",))
    theirs = tuple(connect or ("tcp/127.0.0.1:7447",))
    check_endpoints((*ours, *theirs))
    if not insecure:
        refuse_exposed(ours)
    check_hosts((*ours, *theirs))
    session = open_session(server_configuration(listen=ours, connect=theirs))
    unread = UnreadDatagrams(ours)
    try:
        _refuse_itself(session, theirs)
        STDERR.print(f"router from {', '.join(theirs)} to {', '.join(ours)}", highlight=False)
        while not stop.wait(LOOK_SECONDS):
            unread.look()
    finally:
        close_session(session, [])


def _refuse_itself(session: zenoh.Session, connect: Iterable[str]) -> None:
    """Zenoh notices, and tries again for ever. One address has many names: who answers there says who it is."""
    for endpoint in connect:
        try:
            visitor = open_session(client_configuration([endpoint], timeout=0.0, reconnect=False))
        except ProtocolError:
            # Nobody is there yet, whom the router waits for.
            continue
        found = session.zid() in visitor.info.routers_zid()
        close_session(visitor, [])
        if found:
            raise NetworkError(
                f"router: whoever listens on {endpoint}, to which it connects, is the router itself; --connect must "
                "name the server or another router"
            )
