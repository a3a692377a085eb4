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
from kuglice.lab.network.interruption import LONGEST_SECONDS, Interruption
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
    cut: Annotated[
        list[str] | None,
        typer.Option(
            metavar="AT:SECONDS",
            help=f"Cut the link AT seconds after the start, for SECONDS (up to {LONGEST_SECONDS:g}): connections break "
            "off, none comes about until it is over, and datagrams are lost. May be repeated.",
        ),
    ] = None,
    stall: Annotated[
        list[str] | None,
        typer.Option(
            metavar="AT:SECONDS",
            help="Hold everything, likewise, and let it on afterwards: nothing is lost. May be repeated.",
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="Of all that is random.")] = 1,
) -> None:
    """Put a bad network between a server and its clients.

    It relays TCP connections and UDP datagrams of one port, whichever of them an endpoint names; a bare host:port
    will do. Cuts and stalls that overlap last until the last of them is over. Ends on SIGINT or SIGTERM.

    Example: kuglice proxy --round-trip 300, and then kuglice client --connect tcp+udp/127.0.0.1:7448

    Example: kuglice proxy --cut 20:5 --stall 40:1.5
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
    interruptions = [Interruption.parse("cut", text) for text in cut or ()]
    interruptions += [Interruption.parse("stall", text) for text in stall or ()]
    ours, theirs = address(listen), address(target)
    if ours == theirs:
        raise NetworkError(
            f"proxy: listens on {listen} and relays to it, which is itself; TARGET must be the server"
        )
    check_hosts(one if "/" in one else f"tcp+udp/{one}" for one in (listen, target))
    stop = stop_on_signals()
    relay = Proxy(ours, theirs, conditions)

    def interrupt(interruption: Interruption) -> None:
        relay.interrupt(interruption)
        STDERR.print(str(interruption), highlight=False)

    async def until_stopped() -> None:
        await relay.start()
        STDERR.print(f"{listen} to {target}: {conditions}", highlight=False)
        for interruption in interruptions:
            asyncio.get_running_loop().call_later(interruption.at, interrupt, interruption)
        while not stop.is_set():
            await asyncio.sleep(POLL_SECONDS)
        relay.close()

    asyncio.run(until_stopped())
    for name, count in sorted(relay.counter.items()):
        STDERR.print(f"{name}: {count:,}", highlight=False)
