"""`kuglice server SCENE`: serve a world."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.status import Status

from kuglice import scenes
from kuglice.cli.figures import print_figures
from kuglice.cli.logs import STDERR, log_to_stderr
from kuglice.cli.pins import Broadphase, Contacts, Integrator, Substeps, pinned
from kuglice.cli.stop import stop_on_signals
from kuglice.cli.threads import Threads
from kuglice.cli.writable import writable_file
from kuglice.protocol import DEFAULT_ENDPOINT, check_hosts
from kuglice.wording import of_many
from kuglice_server.server import Server
from kuglice_server.settings import ServerSettings

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("server")(server)


def server(
    scene: Annotated[str, typer.Argument(help="A TOML file or a built-in scene.", metavar="SCENE")],
    *,
    listen: Annotated[
        list[str] | None,
        typer.Option(
            help="Endpoint to listen on: tcp/host:port, or tcp+udp/host:port, where ticks and inputs go as "
            f"datagrams; may be repeated. [default: {DEFAULT_ENDPOINT}]"
        ),
    ] = None,
    connect: Annotated[
        list[str] | None, typer.Option(help="Endpoint of a router that runs already, instead of listening.")
    ] = None,
    world: Annotated[
        str | None, typer.Option(help="Name of the world in the keys. [default: the scene's name]")
    ] = None,
    rate: Annotated[
        float | None,
        typer.Option(help="Ticks per second of wall clock; same bits. [default: the scene's tick rate]"),
    ] = None,
    snapshot_every: Annotated[
        int | None,
        typer.Option(
            help="Ticks between snapshots, kept for who joins and sent to who checks. [default: a second's worth]"
        ),
    ] = None,
    hash_every: Annotated[
        int | None,
        typer.Option(
            help="Ticks between states whose hash is told. [default: 1; a second's worth above 100,000 balls]"
        ),
    ] = None,
    region_rate: Annotated[
        float, typer.Option(help="Times per second that views are told of the regions they look at.")
    ] = 10.0,
    grace: Annotated[
        float,
        typer.Option(
            help="Seconds for which a player whose link was cut keeps its ball, to go on with it; less than 1 is 1."
        ),
    ] = 10.0,
    record: Annotated[
        Path | None,
        typer.Option(
            callback=writable_file,
            help="Write a replay file. An existing one is replaced once the server runs, unless another writes it.",
        ),
    ] = None,
    threads: Threads = 1,
    integrator: Integrator = None,
    contacts: Contacts = None,
    substeps: Substeps = None,
    broadphase: Broadphase = None,
    seconds: Annotated[
        float | None, typer.Option(min=0.0, help="Stop after this long. [default: on SIGINT or SIGTERM]")
    ] = None,
    until_empty: Annotated[
        bool, typer.Option("--until-empty", help="Stop when the last client has left.")
    ] = False,
    insecure: Annotated[
        bool, typer.Option("--insecure", help="Allow listening on addresses that others can reach.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the closing figures as JSON.")] = False,
) -> None:
    """Serve a world to the clients that join.

    Steps it at a fixed rate, publishes it, and takes inputs. Nothing else need be started: the server is its
    own Zenoh router.

    Example: kuglice server arena --record game.kuglice
    """
    log_to_stderr()
    stop = stop_on_signals()
    settings = ServerSettings(
        world=world or _name_of(scene),
        listen=tuple(listen or (() if connect else (DEFAULT_ENDPOINT,))),
        connect=tuple(connect or ()),
        rate=rate,
        snapshot_every=snapshot_every,
        hash_every=hash_every,
        region_rate=region_rate,
        record=record,
        grace=grace,
        threads=threads,
        insecure=insecure,
    )
    check_hosts((*settings.listen, *settings.connect))
    chosen = pinned(
        scenes.find(scene), integrator=integrator, contacts=contacts, substeps=substeps, broadphase=broadphase
    )
    with Server(chosen, settings) as running:
        where = ", ".join((*settings.listen, *settings.connect))
        STDERR.print(
            f"world {settings.world} of {running.world.count:,} {of_many(running.world.count, 'ball')}"
            f" on {where}: {running.world.model}"
        )
        with STDERR.status("starting") as line:
            running.run(stop, seconds=seconds, until_empty=until_empty, each_tick=_teller(line))
        figures = _figures(running)
    print_figures(f"Server of {settings.world}", {"server": figures}, as_json=as_json)


def _name_of(scene: str) -> str:
    stem = Path(scene.partition(":")[0]).stem
    return re.sub(r"[^A-Za-z0-9_-]", "-", stem).strip("-_")[:32] or "world"


def _teller(line: Status) -> Callable[[Server], None]:
    told = time.monotonic()

    def tell(running: Server) -> None:
        nonlocal told
        now = time.monotonic()
        if now - told >= 1:
            told = now
            status = running.status()
            line.update(f"tick {status.tick:,}, {status.balls:,} balls, {len(status.clients)} clients")

    return tell


def _figures(running: Server) -> dict[str, Any]:
    status = running.status()
    return {
        "world": status.world,
        "epoch": status.epoch,
        "ticks": status.tick,
        "final_hash": f"{running.world.state_hash:016x}",
        "balls": status.balls,
        "inputs_applied": running.world.inputs_applied,
        "inputs_ignored": running.world.inputs_ignored,
        "late_ticks": status.counters["late_ticks"],
        "seconds_lost": status.seconds_lost,
        "worst_lateness_ms": 1000 * status.worst_lateness,
        **dict(sorted(running.counters.all().items())),
    }
