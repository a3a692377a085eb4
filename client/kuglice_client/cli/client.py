"""`kuglice client`: join a server, play or watch."""

from __future__ import annotations

import random
import secrets
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer
from rich.status import Status

from kuglice.cli.figures import print_figures, print_groups
from kuglice.cli.logs import STDERR, log_to_stderr
from kuglice.cli.stop import stop_on_signals
from kuglice.cli.writable import writable_file, writable_folder
from kuglice.extras import require
from kuglice.protocol import DEFAULT_ENDPOINT
from kuglice_client.bots import BOTS
from kuglice_client.cli.finishing import finished
from kuglice_client.cli.groups import CLIENT
from kuglice_client.cli.options import (
    AsJson,
    FilmRate,
    FilmStyle,
    Render,
    Seconds,
    SummaryJson,
    Wait,
    write_summary,
)
from kuglice_client.client import Client
from kuglice_client.render import parse_size
from kuglice_client.settings import ClientSettings

if TYPE_CHECKING:
    from kuglice_client.filming import Film, FilmSettings

__all__ = ["register"]

OF_PLAYERS = frozenset({"name", "number", "inputs_accepted", "inputs_refused", "inputs_late"})
"""Figures that a spectator has none of: programs get them empty, people not at all."""
OF_PROGRAMS = frozenset({"recovered_at_monotonic"})
"""Of what a game felt like: readings of a clock that says nothing to people."""


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("client")(client)


def client(
    *,
    connect: Annotated[
        list[str] | None,
        typer.Option(
            help="Endpoint of the server: tcp/host:port, or tcp+udp/host:port to take ticks and send inputs as "
            f"datagrams where they get through. [default: {DEFAULT_ENDPOINT}]"
        ),
    ] = None,
    world: Annotated[
        str | None, typer.Option(help="World to join. [default: the only one served there]")
    ] = None,
    name: Annotated[str | None, typer.Option(help="Name to play under. [default: made up for a bot]")] = None,
    bot: Annotated[
        str | None,
        typer.Option(help=f"Who plays: {', '.join(BOTS)}. Without bot and name, you are a spectator."),
    ] = None,
    seconds: Seconds = None,
    wait: Wait = 10.0,
    render: Render = None,
    fps: FilmRate = 30,
    size: Annotated[str, typer.Option(help="Width and height of the film in pixels.")] = "1280x720",
    style: FilmStyle = "discs",
    overlay: Annotated[
        list[str] | None, typer.Option(help="tick, tree, scale; may be repeated. [default: tick]")
    ] = None,
    trails: Annotated[float, typer.Option(help="Seconds after which a trail has faded, 0 for none.")] = 0.0,
    still_every: Annotated[
        float,
        typer.Option(min=0.0, max=3600.0, help="Seconds between PNG frames beside the film, 0 for none."),
    ] = 0.0,
    lose: Annotated[
        float, typer.Option(min=0.0, max=0.99, help="Share of tick messages to throw away, to see them heal.")
    ] = 0.0,
    input_delay: Annotated[
        int, typer.Option(min=0, help="Ticks between an own input and its effect; less lead is needed.")
    ] = 0,
    check_snapshots: Annotated[
        bool,
        typer.Option(
            "--check-snapshots",
            help="Compare the server's snapshots too, not hashes alone; needs far more bytes.",
        ),
    ] = False,
    study: Annotated[
        Path | None,
        typer.Option(
            callback=writable_file,
            help="Record what is seen, acted and confirmed, for `kuglice study`: up to 1 GB an hour. An "
            "existing file is replaced once you have joined, unless another client writes it.",
        ),
    ] = None,
    desync_reports: Annotated[
        Path | None,
        typer.Option(
            callback=writable_folder,
            help="Write a JSON file per desync into this directory: first tick, balls, all differing bits.",
        ),
    ] = None,
    summary_json: SummaryJson = None,
    as_json: AsJson = False,
) -> None:
    """Join a server: play as a bot, or watch; film it.

    The world is the server's bit for bit. Without bot and name you are a spectator.

    Ends with status 1 if any state differed from the server's, or if none could be compared.

    Example: kuglice client --bot chaser --seconds 10 --render out/chaser.mp4
    """
    log_to_stderr()
    stop = stop_on_signals()
    settings = ClientSettings(
        connect=tuple(connect or (DEFAULT_ENDPOINT,)),
        world=world,
        name=f"{bot}-{secrets.token_hex(3)}" if name is None and bot is not None else name,
        bot=bot,
        wait=wait,
        lose=(lambda _: random.random() < lose) if lose else None,
        input_delay=input_delay,
        study=study,
        check_snapshots=check_snapshots,
        desync_reports=desync_reports,
    )
    look = _Look(fps, parse_size(size), style, tuple(overlay or ("tick",)), trails, still_every)
    film_settings = _film_settings(render, look)
    film = None
    summary: dict[str, Any] = {}
    playing = Client(settings, stop)
    try:
        if film_settings is not None:
            film = _film(playing, film_settings)
        with STDERR.status("playing") as line:
            playing.run(
                seconds=seconds,
                fps=None if film is None else fps,
                each_frame=_shower(film, look, line),
            )
        summary = playing.summary()
    finally:
        # Whatever happened: the server is told at once, and what was played becomes a film.
        playing.close()
        if film is not None:
            summary |= finished(film)
    write_summary(summary_json, summary)
    title = f"Client {settings.name or '(spectator)'}"
    if as_json:
        print_figures(title, {"client": summary}, as_json=True)
    else:
        watching = settings.name is None
        shown = {name: value for name, value in summary.items() if not (watching and name in OF_PLAYERS)}
        shown["feel"] = {name: value for name, value in summary["feel"].items() if name not in OF_PROGRAMS}
        print_groups(title, shown, CLIENT)
    if not summary["agreed"]:
        compared = summary["hashes_checked"] > 0
        STDERR.print("states differed from the server's" if compared else "nothing could be compared")
        raise typer.Exit(1)
    if "film_error" in summary:
        raise typer.Exit(2)


class _Look(NamedTuple):
    fps: int
    size: tuple[int, int]
    style: str
    overlays: tuple[str, ...]
    trails: float
    still_every: float


def _film_settings(path: Path | None, look: _Look) -> FilmSettings | None:
    """What cannot be drawn is refused before anybody is joined, not after the play."""
    from kuglice_client.filming import FilmSettings  # noqa: PLC0415 - few clients film
    from kuglice_client.render import check_look  # noqa: PLC0415

    if path is None:
        # A wrong word is a wrong word, even if nothing is drawn.
        check_look(style=look.style, overlays=look.overlays, trails=look.trails)
        return None
    settings = FilmSettings(
        path=path,
        fps=look.fps,
        size=look.size,
        style=look.style,
        overlays=look.overlays,
        trails=look.trails,
        still_every=round(look.still_every * look.fps),
    )
    require("render")
    return settings


def _film(playing: Client, settings: FilmSettings) -> Film:
    from kuglice_client.filming import Film  # noqa: PLC0415 - few clients film

    joined = playing.replica.joined
    settings = replace(settings, own=joined.number)
    return Film(joined.scene, settings, balls=playing.confirmed.count)


def _shower(film: Film | None, look: _Look, line: Status) -> Callable[[Client, float], None]:
    told = time.monotonic()

    def show(playing: Client, alpha: float) -> None:
        nonlocal told
        if film is not None:
            film.add(playing.moment(alpha, nodes="tree" in look.overlays))
        if time.monotonic() - told >= 1:
            told = time.monotonic()
            checks = playing.replica.reconciler
            line.update(
                f"tick {playing.confirmed.tick:,}, {checks.hashes_checked:,} hashes checked, "
                f"{checks.hash_mismatches} different"
            )

    return show
