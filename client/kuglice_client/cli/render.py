"""`kuglice render SCENE`: a scene as a film or as pictures."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from kuglice.cli.figures import print_figures
from kuglice.cli.logs import STDERR
from kuglice.cli.pins import Broadphase, Contacts, Integrator, Substeps, pinned
from kuglice.cli.stop import stop_on_signals
from kuglice.cli.threads import Threads
from kuglice.cli.writable import writable
from kuglice.errors import PictureError
from kuglice.scenes import find
from kuglice.world import World
from kuglice_client.render import OUTPUTS, OVERLAYS, STYLES, film, parse_size

__all__ = ["register"]

KINDS = ", ".join(suffix for suffix in OUTPUTS if suffix)


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("render")(render)


def render(  # noqa: PLR0917 - options
    scene: Annotated[str, typer.Argument(help="A TOML file or a built-in scene.", metavar="SCENE")],
    out: Annotated[
        Path,
        typer.Option(
            callback=writable,
            help=f"Where to: {KINDS}, or a directory. frame-%05d.png has all frames, frame.png the last one.",
        ),
    ],
    seconds: Annotated[float, typer.Option(help="How much of the scene, in its own time.")] = 10.0,
    threads: Threads = 1,
    integrator: Integrator = None,
    contacts: Contacts = None,
    substeps: Substeps = None,
    broadphase: Broadphase = None,
    fps: Annotated[float, typer.Option(help="Frames per second.")] = 30.0,
    speed: Annotated[float, typer.Option(help="Seconds of the scene per second of the film.")] = 1.0,
    style: Annotated[str, typer.Option(help=f"How balls look: {', '.join(STYLES)}.")] = "discs",
    overlay: Annotated[
        list[str] | None,
        typer.Option(
            help=f"What is drawn over them: {', '.join(OVERLAYS)}, or none. Repeat it for more than one."
        ),
    ] = None,
    trails: Annotated[float, typer.Option(help="Seconds after which a trail has faded, 0 for none.")] = 0.0,
    size: Annotated[str, typer.Option(help="Width x height in pixels.")] = "1280x720",
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Draw a scene as a film or as pictures.

    It runs without inputs. The first interrupt ends the film early, and finishes its file.

    kuglice render dam:n=2000 --style fluid --out dam.mp4

    kuglice render mine.toml --contacts overlap --out overlap.mp4

    kuglice render break --trails 0.4 --speed 0.25 --size 1920x1080 --out break.webm
    """
    if not 0 <= seconds <= 86_400:
        raise PictureError(f"seconds {seconds}: must be within 0 and 86400")
    chosen = pinned(
        find(scene), integrator=integrator, contacts=contacts, substeps=substeps, broadphase=broadphase
    )
    world = World(chosen, threads=threads)
    ticks = round(seconds * world.scene.tick_rate)
    stop = stop_on_signals()
    started = time.monotonic()
    with _progress(ticks) as done:
        frames = film(
            _run(world, ticks, stop, done),
            out,
            fps=fps,
            speed=speed,
            size=parse_size(size),
            style=style,
            overlays=tuple(name for name in overlay or ["tick"] if name != "none"),
            trails=trails,
        )
    figures = {
        "out": str(out),
        "frames": frames,
        "ticks": world.tick,
        "balls": world.count,
        "model": str(world.model),
        "state_hash": f"{world.state_hash:016x}",
        "seconds_taken": time.monotonic() - started,
    }
    print_figures(f"Film of {world.scene.title or scene}", {"film": figures}, as_json=as_json)


def _run(world: World, ticks: int, stop: threading.Event, done: Callable[[], None]) -> Iterator[World]:
    yield world
    for _ in range(ticks):
        if stop.is_set():
            return
        world.step()
        done()
        yield world


@contextmanager
def _progress(ticks: int) -> Iterator[Callable[[], None]]:
    columns = (
        TextColumn("drawing"),
        BarColumn(),
        TextColumn("{task.percentage:.0f} %"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=STDERR, transient=True, disable=not STDERR.is_terminal) as progress:
        task = progress.add_task("drawing", total=ticks)
        yield lambda: progress.advance(task)
