"""From what a user types to a scene: "gas", "gas:n=2000,packing=0.5" or "my/scene.toml"."""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from kuglice.errors import SceneError
from kuglice.scene import Scene
from kuglice.scenes.table import TABLE

__all__ = ["find", "parameters"]


def find(text: str) -> Scene:
    """A file if it ends in .toml, else a built-in scene, with parameters after a colon. Raises SceneError."""
    if text.endswith(".toml") or _there(text, Path.is_file):
        return Scene.load(text)
    if text and _there(text, Path.is_dir):
        raise SceneError(f"scene {text!r}: is a directory, must be a TOML file or one of {', '.join(TABLE)}")
    name, _, given = text.partition(":")
    make = TABLE.get(name)
    if make is None:
        raise SceneError(f"scene {name!r}: neither a file nor one of {', '.join(TABLE)}{_guess(name, TABLE)}")
    values = _values(name, make, given)
    try:
        return make(**values)
    except SceneError as error:
        if str(error).startswith(f"scene {name}:"):
            raise
        # A schema names keys of a scene that the user has not written.
        raise SceneError(
            f"scene {text!r}: these parameters make no scene: {error}", error.problems
        ) from error
    except (ArithmeticError, ValueError, MemoryError) as error:
        # A size of 0, -1 or 1e300 is stopped by arithmetic before any schema sees it.
        raise SceneError(f"scene {text!r}: these parameters make no scene: {error}") from error


def _there(text: str, kind: Callable[[Path], bool]) -> bool:
    try:
        return kind(Path(text))
    except OSError:
        # Longer than any name of a file.
        return False


def parameters(make: Callable[..., Scene]) -> dict[str, int | float]:
    """Names and defaults of a built-in scene."""
    return {name: each.default for name, each in inspect.signature(make).parameters.items()}


def _values(scene: str, make: Callable[..., Scene], given: str) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for part in filter(None, given.split(",")):
        name, value = _parameter(scene, make, part)
        if name in values:
            raise SceneError(f"scene {scene}: {name} = {value}: is given twice, first as {values[name]}")
        values[name] = value
    return values


def _parameter(scene: str, make: Callable[..., Scene], text: str) -> tuple[str, Any]:
    name, equals, value = (part.strip() for part in text.partition("="))
    known = parameters(make)
    listed = ", ".join(f"{key}={default}" for key, default in known.items()) or "none"
    if name not in known:
        guess = _guess(name, known)
        raise SceneError(f"scene {scene}: {name!r} is none of its parameters, which are {listed}{guess}")
    if not equals:
        raise SceneError(
            f"scene {scene}: {text!r} has no value: must be parameter=value, like {name}={known[name]}"
        )
    kind = type(known[name])
    try:
        return name, kind(value)
    except ValueError:
        wanted = "a whole number" if kind is int else "a number"
        raise SceneError(f"scene {scene}: {name} = {value!r}: must be {wanted}") from None


def _guess(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    return f"; did you mean {near[0]}?" if near else ""
