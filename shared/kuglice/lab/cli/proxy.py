"""`kuglice proxy`: put a bad network between a server and its clients, by hand."""

from __future__ import annotations

import asyncio
from typing import Annotated

import typer

from kuglice.cli.logs import STDERR
from kuglice.cli.stop import stop_on_signals
from kuglice.errors import NetworkError
from kuglice.lab.network.addresses import address
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.proxy import Proxy
from kuglice.protocol import DEFAULT_ENDPOINT, check_hosts

__all__ = ["register"]

POLL_SECONDS = 0.05


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("proxy")(proxy)


def proxy(
    listen: Annotated[
        str, typer.Argument(help="Endpoint where clients connect.", metavar="LISTEN")
    ] = "tcp+udp/127.0.0.1:7448",
    target: Annotated[
        str, typer.Argument(help="Endpoint of the server.", metavar="TARGET")
    ] = DEFAULT_ENDPOINT,
    *,
    round_trip: Annotated[float, typer.Option(help="Milliseconds there and back.")] = 150.0,
    jitter: Annotated[float, typer.Option(help="Share of the delay that it varies by, both ways.")] = 0.2,
    loss: Annotated[float, typer.Option(help="Share of packets that are lost.")] = 0.02,
    duplicate: Annotated[float, typer.Option(help="Share of datagrams that come twice.")] = 0.0,
    reorder: Annotated[bool, typer.Option("--reorder", help="Let datagrams overtake each other.")] = False,
    bandwidth: Annotated[float, typer.Option(help="Bytes per second each way, 0 for no limit.")] = 0.0,
    seed: Annotated[int, typer.Option(help="Of all that is random.")] = 1,
) -> None:
    """Put a bad network between a server and its clients.

    It relays TCP connections and UDP datagrams of one port, whichever of them an endpoint names; a bare host:port
    will do. Ends on SIGINT or SIGTERM.

    Example: kuglice proxy --round-trip 300, and then kuglice client --connect tcp+udp/127.0.0.1:7448
    """
    conditions = Conditions(
        round_trip=round_trip / 1000,
        jitter=jitter,
        loss=loss,
        duplicate=duplicate,
        reorder=reorder,
        bandwidth=bandwidth,
        seed=seed,
    )
    ours, theirs = address(listen), address(target)
    if ours == theirs:
        raise NetworkError(
            f"proxy: listens on {listen} and relays to it, which is itself; TARGET must be the server"
        )
    check_hosts(one if "/" in one else f"tcp+udp/{one}" for one in (listen, target))
    stop = stop_on_signals()
    relay = Proxy(ours, theirs, conditions)

    async def until_stopped() -> None:
        await relay.start()
        STDERR.print(f"{listen} to {target}: {conditions}", highlight=False)
        while not stop.is_set():
            await asyncio.sleep(POLL_SECONDS)
        relay.close()

    asyncio.run(until_stopped())
    for name, count in sorted(relay.counter.items()):
        STDERR.print(f"{name}: {count:,}", highlight=False)
