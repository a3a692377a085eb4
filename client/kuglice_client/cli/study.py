"""`kuglice study FILE`: what a client saw, against what the server's world was."""

from __future__ import annotations

import csv
import json
import statistics
from dataclasses import asdict, fields
from pathlib import Path
from typing import Annotated

import typer

from kuglice.cli.figures import print_figures
from kuglice.cli.logs import STDERR
from kuglice.cli.rows import print_rows
from kuglice.cli.writable import writable, writable_file
from kuglice.extras import require
from kuglice.study import SeenFrame, Study, other_screen_delays
from kuglice.study.table import by_second, summary
from kuglice_client.render.seen import film_of_seen

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("study")(study)


def study(  # noqa: PLR0917 - options
    file: Annotated[Path, typer.Argument(help="What `kuglice client --study` wrote.", metavar="FILE")],
    other: Annotated[
        list[Path] | None,
        typer.Option(
            help="Study of another client of the same game and machine: how long until her inputs were seen here. "
            "May be repeated."
        ),
    ] = None,
    frames_csv: Annotated[
        Path | None,
        typer.Option("--csv", callback=writable_file, help="Write a row for every frame that was compared."),
    ] = None,
    render: Annotated[
        Path | None,
        typer.Option(callback=writable, help="Draw what was seen: .mp4, .webm, .gif, or frame-%05d.png."),
    ] = None,
    fps: Annotated[float, typer.Option(help="Frames per second of the film.", min=1.0, max=240.0)] = 30.0,
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Compare what a client drew with the server's world.

    Tick by tick, told second by second. Errors are how far balls were drawn from where the server had them, in radii,
    corrections that glide included. "predicted equal" is the share of frames whose predicted state had the server's
    very bits. Ends with status 2 if the file is no study or damaged.
    """
    seen = Study.load(file)
    frames = list(seen.frames())
    figures = summary(seen, frames)
    for path in other or []:
        acting = Study.load(path)
        delays = other_screen_delays(acting, seen)
        figures.setdefault("other_screen_delay_ms", {})[acting.joined.name or str(path)] = (
            1000 * statistics.fmean(delays) if delays else None
        )
    if frames_csv is not None:
        _write(frames_csv, frames)
    if render is not None:
        require("render")
        with STDERR.status("drawing"):
            figures["frames_of_the_film"] = film_of_seen(seen.seen(), render, fps=fps, own=seen.joined.number)
    seconds = by_second(seen, frames)
    if as_json:
        print(json.dumps({"study": figures, "seconds": seconds}, indent=2))
        return
    if seconds:
        shown = [{name.replace("_", " "): value for name, value in row.items()} for row in seconds]
        print_rows(f"{file}, second by second", shown, as_json=False)
    print_figures(f"Study of {seen.joined.name or '(spectator)'}", {"study": figures}, as_json=False)
    explained = "predicted equal: share of frames whose state had the server's very bits; 1 is all of them"
    STDERR.print(explained, highlight=False)


def _write(path: Path, frames: list[SeenFrame]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(SeenFrame)])
        writer.writeheader()
        writer.writerows(asdict(frame) for frame in frames)
