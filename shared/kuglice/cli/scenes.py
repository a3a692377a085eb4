"""`kuglice scenes`: what there is to run."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from kuglice.cli.rows import print_rows
from kuglice.errors import SceneError
from kuglice.scene import Scene
from kuglice.scenes import TABLE, find
from kuglice.scenes.find import parameters

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("scenes")(scenes)


def scenes(
    scene: Annotated[
        list[str] | None,
        typer.Argument(help="Only these, by name, with parameters, or as files.", metavar="[SCENE]..."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
    write: Annotated[
        Path | None, typer.Option(help="Save each as NAME.toml in this directory, to be changed and run.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Let --write replace files.")] = False,
) -> None:
    """List the built-in scenes and their parameters.

    A parameter is set after the name: kuglice plan gas:n=2000,packing=0.5
    """
    found = {text: find(text) for text in scene or TABLE}
    if write is not None:
        _write(found, write, force)
        return
    print_rows("Scenes", [_row(text, each) for text, each in found.items()], as_json=as_json)


def _row(text: str, scene: Scene) -> dict[str, Any]:
    make = TABLE.get(text.partition(":")[0])
    listed = {} if make is None else parameters(make)
    return {
        "scene": text,
        "balls": len(scene.balls),
        "shows": scene.description,
        "parameters": " ".join(f"{name}={default}" for name, default in listed.items()),
    }


def _write(found: dict[str, Scene], directory: Path, force: bool) -> None:
    paths = {text: directory / f"{Path(text.partition(':')[0]).stem}.toml" for text in found}
    # All or nothing: half a set of files would be worse than a refusal.
    for path in paths.values():
        if path.exists() and not force:
            raise SceneError(f"{path}: exists already; --force replaces it")
    try:
        directory.mkdir(parents=True, exist_ok=True)
        for text, path in paths.items():
            found[text].save(path)
            print(path)
    except OSError as error:
        raise SceneError(f"{error.filename or directory}: cannot be written: {error.strerror}") from error
