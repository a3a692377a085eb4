"""Scenes as TOML files. Floats are written with all digits, so that a scene comes back bit for bit."""

from __future__ import annotations

import re
import tomllib
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import tomli_w
from numpy.typing import NDArray
from pydantic import BaseModel, ValidationError

from kuglice.balls import PI, Balls
from kuglice.errors import SceneError
from kuglice.layout import Group, ListedGroup, place
from kuglice.schema.problems import told

if TYPE_CHECKING:
    from kuglice.scene.scene import Scene

__all__ = ["read_scene", "write_scene"]

SHORT = 6
"""Arrays of up to so many numbers are written on one line."""
NUMBERS = re.compile(rf"\[\n((?:\s*[-+0-9.einf]+,\n){{1,{SHORT}}})\s*\]")
"""An array of numbers over several lines; a string never holds a bare newline, so none can match."""


def read_scene(path: str | PathLike[str]) -> Scene:
    """Raises SceneError that names file, key, value and bound of every problem."""
    from kuglice.scene.scene import Scene  # noqa: PLC0415 - Scene.load comes here

    try:
        table = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise SceneError(f"{path}: cannot be read: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SceneError(f"{path}: not TOML: {error}") from error
    except RecursionError:
        raise SceneError(f"{path}: not TOML: arrays nested too deeply") from None
    try:
        return Scene.model_validate(table)
    except ValidationError as error:
        raise told(error, SceneError, str(path), Scene.model_fields) from None


def write_scene(scene: Scene, path: str | PathLike[str]) -> None:
    """Groups are written as such if they still place the scene's balls; otherwise the balls one by one."""
    text = tomli_w.dumps(_table(scene))
    Path(path).write_text(NUMBERS.sub(_on_one_line, text), encoding="utf-8")


def _table(scene: Scene) -> dict[str, Any]:
    table = _given(scene)
    for name in ("forces", "groups", "balls"):
        table.pop(name, None)
    table["box"] = list(scene.box)
    if scene.forces:
        table["forces"] = [{"kind": force.kind, **_members(force)} for force in scene.forces]
    if scene.groups and place(scene.groups, scene.box) == scene.balls:
        table["groups"] = [_group(group) for group in scene.groups]
    elif len(scene.balls):
        table["balls"] = _balls(scene.balls)
    return table


def _given(schema: BaseModel) -> dict[str, Any]:
    """What differs from the defaults; TOML has no word for None."""
    return schema.model_dump(mode="json", exclude={"balls"}, exclude_defaults=True, exclude_none=True)


def _members(force: object) -> dict[str, Any]:
    return {name: value for name, value in vars(force).items() if name != "kind" and not name.startswith("_")}


def _group(group: Group) -> dict[str, Any]:
    if isinstance(group, ListedGroup):
        return {"layout": group.layout, **_balls(group.balls)}
    # mode="python" keeps an infinite mass, which JSON does not know.
    dumped = group.model_dump(exclude_defaults=True, exclude_none=True)
    return {"layout": group.layout, **{name: _listed(value) for name, value in dumped.items()}}


def _listed(value: object) -> object:
    return list(value) if isinstance(value, tuple) else value


def _balls(balls: Balls) -> dict[str, Any]:
    table = {
        "position": balls.position.tolist(),
        "velocity": _once(balls.velocity),
        "radius": _once(balls.radius),
    }
    if (balls.mass != PI * balls.radius * balls.radius).any():
        table["mass"] = _once(balls.mass)
    return table


def _once(array: NDArray[np.float64]) -> object:
    """One value for all where all are equal, bit for bit."""
    bits = array.view(np.uint64)
    return (array[0] if len(array) and (bits == bits[0]).all() else array).tolist()


def _on_one_line(match: re.Match[str]) -> str:
    return f"[{', '.join(match[1].replace(',', ' ').split())}]"
