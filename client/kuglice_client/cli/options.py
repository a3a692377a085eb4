"""The options that players and views share: how long, what is filmed, where the closing figures go."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from kuglice.cli.writable import writable, writable_file

__all__ = ["AsJson", "FilmRate", "FilmStyle", "Render", "Seconds", "SummaryJson", "Wait", "write_summary"]

Seconds = Annotated[
    float | None, typer.Option(min=0.0, help="Leave after this long. [default: on SIGINT or SIGTERM]")
]
Wait = Annotated[
    float,
    typer.Option(
        min=0.0,
        help="Seconds that joining may take: then it ends with an error that says what did not come. 0 for one try.",
    ),
]
Render = Annotated[
    Path | None,
    typer.Option(
        callback=writable,
        help="Film what is seen: .mp4, .webm, .gif, or frame-%05d.png. An existing film is replaced once you have "
        "joined.",
    ),
]
FilmRate = Annotated[int, typer.Option(min=1, max=240, help="Frames per second of the film.")]
FilmStyle = Annotated[str, typer.Option(help="discs or fluid.")]
SummaryJson = Annotated[
    Path | None,
    typer.Option(
        callback=writable_file,
        help="Write the closing figures to this file too; an existing one is replaced.",
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print the closing figures as JSON.")]


def write_summary(path: Path | None, summary: dict[str, Any]) -> None:
    """Write the closing figures to the file that `SummaryJson` names, if it names one."""
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(summary, indent=2) + "\n")
