"""`kuglice view X,Y,WIDTH,HEIGHT`: look at a part of a world, and be told of nothing else."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.status import Status
from typer.core import TyperCommand

from kuglice.cli.figures import print_figures, print_groups
from kuglice.cli.logs import STDERR, log_to_stderr
from kuglice.cli.stop import stop_on_signals
from kuglice.extras import require
from kuglice.protocol import DEFAULT_ENDPOINT, Rectangle
from kuglice_client.cli.finishing import finished
from kuglice_client.cli.groups import VIEW
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
from kuglice_client.view import View, ViewSettings, parse_rectangle

if TYPE_CHECKING:
    from kuglice_client.filming import Film, FilmSettings

__all__ = ["register"]

MOVED_EVERY_SECONDS = 0.1
FASTEST_PAN = 1e6
NUMBERS = re.compile(r"-[\d.][^,]*,")
OVERLAYS = ("tick", "scale")


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("view", cls=_Signed)(view)


class _Signed(TyperCommand):
    """Takes numbers with a comma between them for what they are: a minus sign before them begins no option."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: ANN401 - typer hides its class
        return super().parse_args(ctx, [f" {word}" if NUMBERS.match(word) else word for word in args])


def view(
    rectangle: Annotated[
        str,
        typer.Argument(
            help="Left bottom corner, of either sign, and size, in metres.", metavar="X,Y,WIDTH,HEIGHT"
        ),
    ],
    *,
    connect: Annotated[
        list[str] | None, typer.Option(help=f"Endpoint of the server. [default: {DEFAULT_ENDPOINT}]")
    ] = None,
    world: Annotated[
        str | None, typer.Option(help="World to look at. [default: the only one served there]")
    ] = None,
    margin: Annotated[
        float | None,
        typer.Option(help="Metres around it that are followed too. [default: half a region]"),
    ] = None,
    budget: Annotated[
        float | None,
        typer.Option(help="Bytes per second; far regions are told less often. [default: no bound]"),
    ] = None,
    pan: Annotated[str, typer.Option(help="Move by so many metres per second.", metavar="VX,VY")] = "0,0",
    seconds: Seconds = None,
    wait: Wait = 10.0,
    render: Render = None,
    fps: FilmRate = 30,
    width: Annotated[
        int, typer.Option(min=16, max=7680, help="Width of the film in pixels; the height follows.")
    ] = 1280,
    style: FilmStyle = "discs",
    summary_json: SummaryJson = None,
    as_json: AsJson = False,
) -> None:
    """Look at a part of a world: only what is in it is sent here.

    Between two updates the same step runs on the balls that are known, so a view costs what it shows, not what
    the world has. It is told rounded positions: for the world to the last bit, join as a client.

    Ends with status 1 if nothing was told.

    Example: kuglice view 100,100,32,18 --budget 50000 --seconds 10 --render out/view.mp4
    """
    log_to_stderr()
    stop = stop_on_signals()
    settings = ViewSettings(
        rectangle=parse_rectangle(rectangle.strip()),
        connect=tuple(connect or (DEFAULT_ENDPOINT,)),
        world=world,
        margin=margin,
        budget=budget,
        wait=wait,
    )
    velocity = _velocity(pan.strip())
    film_settings = _film_settings(render, settings.rectangle, fps=fps, width=width, style=style)
    film: Film | None = None
    summary: dict[str, Any] = {}
    looking = View(settings, stop)
    try:
        _say_if_outside(settings.rectangle, looking.replica.scene.box)
        show: Callable[[View, float], None] | None = None
        if film_settings is not None:
            film, show = _film(looking, film_settings)
        with STDERR.status("looking") as line:
            looking.run(seconds=seconds, fps=fps, each_frame=_each_frame(velocity, show, line))
        summary = looking.summary()
    finally:
        looking.close()
        if film is not None:
            summary |= finished(film)
    write_summary(summary_json, summary)
    title = f"View of {summary['world']}"
    if as_json:
        print_figures(title, {"view": summary}, as_json=True)
    else:
        print_groups(title, summary, VIEW)
    if not summary["updates"]:
        STDERR.print("nothing was told")
        raise typer.Exit(1)
    if "film_error" in summary:
        raise typer.Exit(2)


def _say_if_outside(rectangle: Rectangle, box: Rectangle) -> None:
    left, bottom, right, top = rectangle
    if right <= box[0] or left >= box[2] or top <= box[1] or bottom >= box[3]:
        STDERR.print(
            f"view {rectangle}: lies outside the world, whose box is {box}", highlight=False, style="yellow"
        )


def _velocity(text: str) -> tuple[float, float]:
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise typer.BadParameter(f"pan {text!r}: must be two numbers VX,VY") from None
    if not max(abs(x), abs(y)) <= FASTEST_PAN:
        raise typer.BadParameter(f"pan {text!r}: at most {FASTEST_PAN:g} metres per second")
    return x, y


def _each_frame(
    velocity: tuple[float, float], show: Callable[[View, float], None] | None, line: Status
) -> Callable[[View, float], None]:
    began = moved = told = time.monotonic()
    start: Rectangle | None = None

    def each_frame(looking: View, alpha: float) -> None:
        nonlocal start, moved, told
        now = time.monotonic()
        start = start or looking.rectangle
        if any(velocity) and now - moved >= MOVED_EVERY_SECONDS:
            moved = now
            x, y = (speed * (now - began) for speed in velocity)
            looking.move((start[0] + x, start[1] + y, start[2] + x, start[3] + y))
        if show is not None:
            show(looking, alpha)
        if now - told >= 1:
            told = now
            line.update(
                f"tick {looking.replica.known.world.tick:,}, {int(looking.in_sight.sum()):,} balls in sight, "
                f"{len(looking.replica.interest.paces)} regions"
            )

    return each_frame


def _film_settings(
    path: Path | None, rectangle: Rectangle, *, fps: int, width: int, style: str
) -> FilmSettings | None:
    from kuglice_client.filming import FilmSettings  # noqa: PLC0415 - few views are filmed
    from kuglice_client.render import check_look  # noqa: PLC0415

    if path is None:
        check_look(style=style, overlays=(), trails=0.0)
        return None
    require("render")
    left, bottom, right, top = rectangle
    # Encoders want even sizes.
    height = 2 * max(8, round(width * (top - bottom) / (right - left) / 2))
    return FilmSettings(path=path, fps=fps, size=(width, height), style=style, overlays=OVERLAYS)


def _film(looking: View, settings: FilmSettings) -> tuple[Film, Callable[[View, float], None]]:
    from dataclasses import replace  # noqa: PLC0415

    from kuglice_client.filming import Film  # noqa: PLC0415 - few views are filmed
    from kuglice_client.view.picture import framed, stage  # noqa: PLC0415

    scene = stage(looking)
    left, bottom, right, top = looking.replica.scene.box
    share = scene.box[2] * scene.box[3] / ((right - left) * (top - bottom))
    film = Film(
        scene,
        replace(settings, reference=looking.replica.about.reference_speed),
        balls=max(1, round(share * looking.replica.about.balls)),
    )

    def show(seen: View, alpha: float) -> None:
        film.add(framed(seen.moment(alpha), seen.rectangle, scene))

    return film, show
