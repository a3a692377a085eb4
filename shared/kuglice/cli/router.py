"""`kuglice router`: pass a world on, so that its server feeds one neighbour instead of many clients."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import typer

from kuglice.cli.logs import STDERR, log_to_stderr
from kuglice.cli.stop import stop_on_signals
from kuglice.errors import NetworkError
from kuglice.protocol import (
    check_endpoints,
    close_session,
    open_session,
    refuse_exposed,
    server_configuration,
)

__all__ = ["register"]


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
    _refuse_itself(ours, theirs)
    session = open_session(server_configuration(listen=ours, connect=theirs))
    try:
        STDERR.print(f"router from {', '.join(theirs)} to {', '.join(ours)}", highlight=False)
        stop.wait()
    finally:
        close_session(session, [])


def _refuse_itself(listen: Iterable[str], connect: Iterable[str]) -> None:
    own = {endpoint.partition("/")[2].partition("?")[0] for endpoint in listen}
    for endpoint in connect:
        if endpoint.partition("/")[2].partition("?")[0] in own:
            raise NetworkError(
                f"router: listens on {endpoint} and connects to it, which is itself; --connect must name the server "
                "or another router"
            )
