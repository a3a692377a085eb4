"""`kuglice replay FILE`: run a recording again and compare every hash."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from importlib.metadata import entry_points
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from kuglice.cli.logs import STDERR
from kuglice.cli.writable import writable
from kuglice.errors import ReplayError
from kuglice.extras import require
from kuglice.replay import Replay, Verification
from kuglice.world import World

__all__ = ["register"]

RENDERERS = "kuglice.renderers"
"""Entry points: functions (worlds, path, fps=..., ...) that draw a run."""
DIFFERENT = 1
"""Exit code if a hash differs."""
CUT_OFF = 3
"""Exit code if all hashes are equal, but the file is not whole."""


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("replay")(replay)


def replay(
    file: Annotated[Path, typer.Argument(help="What `kuglice server --record` wrote.", metavar="FILE")],
    render: Annotated[
        Path | None,
        typer.Option(
            callback=writable, help="Draw it too: .mp4, .webm, .gif, or a directory for PNG frames."
        ),
    ] = None,
    fps: Annotated[float, typer.Option(help="Frames per second of the film.", min=1.0, max=240.0)] = 30.0,
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Run a recording again and compare every hash.

    Ends with status 0 if all hashes are equal, with 1 if one differs, and then names the tick and the balls;
    with 3 if all are equal as far as the file goes, but the recording was cut off there.
    """
    recording = Replay.load(file)
    film = None if render is None else _renderer()
    with _progress(len(recording), "comparing") as done:
        result = recording.verify(watch=lambda _: done())
    frames = 0
    if film is not None:
        with _progress(len(recording), "drawing") as done:
            frames = film(_watched(recording.worlds(), done), render, fps=fps)
    if as_json:
        print(json.dumps(_figures(file, recording, result), indent=2))
    else:
        print(f"{file}: {recording.scene.title or 'scene'}, {recording.model}: {result}")
        if frames:
            print(f"{render}: {frames} frames")
    if not result.ok:
        raise typer.Exit(DIFFERENT)
    if not result.complete:
        raise typer.Exit(CUT_OFF)


def _figures(file: Path, recording: Replay, result: Verification) -> dict[str, Any]:
    figures: dict[str, Any] = {
        "file": str(file),
        "version": recording.version,
        "model": recording.model.to_message(),
        "ticks": result.ticks,
        "hashes": result.hashes,
        "complete": result.complete,
        "equal": result.ok,
    }
    if result.mismatch is not None:
        figures["mismatch"] = {
            "tick": result.mismatch.tick,
            "expected": f"{result.mismatch.expected:016x}",
            "found": f"{result.mismatch.found:016x}",
            "balls": result.mismatch.balls,
        }
    return figures


def _renderer() -> Callable[..., int]:
    require("render")
    for entry in entry_points(group=RENDERERS):
        film: Callable[..., int] = entry.load()
        return film
    raise ReplayError(f"no renderer is installed: nothing registers one in the entry point group {RENDERERS}")


def _watched(worlds: Iterable[World], done: Callable[[], None]) -> Iterator[World]:
    for world in worlds:
        done()
        yield world


@contextmanager
def _progress(ticks: int, what: str) -> Iterator[Callable[[], None]]:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=STDERR, transient=True, disable=not STDERR.is_terminal) as progress:
        # The state at the start counts too.
        task = progress.add_task(what, total=ticks + 1)
        yield lambda: progress.advance(task)
