"""From what a user types to a scene: "gas", "gas:n=2000,packing=0.5" or "my/scene.toml"."""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

from kuglice.errors import SceneError
from kuglice.scene import Scene
from kuglice.scenes.table import TABLE

__all__ = ["find", "parameters"]


def find(text: str) -> Scene:
    """A file if it ends in .toml, else a built-in scene, with parameters after a colon. Raises SceneError."""
    if text.endswith(".toml") or _is_file(text):
        return Scene.load(text)
    name, _, given = text.partition(":")
    make = TABLE.get(name)
    if make is None:
        near = difflib.get_close_matches(name, TABLE, n=1)
        guess = f"; did you mean {near[0]}?" if near else ""
        raise SceneError(f"scene {name!r}: neither a file nor one of {', '.join(TABLE)}{guess}")
    values = dict(_parameter(name, make, part) for part in given.split(",") if part)
    try:
        return make(**values)
    except SceneError:
        raise
    except (ArithmeticError, ValueError, MemoryError) as error:
        # A size of 0, -1 or 1e300 is stopped by arithmetic before any schema sees it.
        raise SceneError(f"scene {text!r}: these parameters make no scene: {error}") from error


def _is_file(text: str) -> bool:
    try:
        return Path(text).is_file()
    except OSError:
        # Longer than any name of a file.
        return False


def parameters(make: Callable[..., Scene]) -> dict[str, int | float]:
    """Names and defaults of a built-in scene."""
    return {name: each.default for name, each in inspect.signature(make).parameters.items()}


def _parameter(scene: str, make: Callable[..., Scene], text: str) -> tuple[str, Any]:
    name, equals, value = (part.strip() for part in text.partition("="))
    known = parameters(make)
    if name not in known or not equals:
        listed = ", ".join(f"{key}={default}" for key, default in known.items())
        raise SceneError(f"scene {scene}: {text!r} is no parameter=value; there are {listed}")
    kind = type(known[name])
    try:
        return name, kind(value)
    except ValueError:
        wanted = "a whole number" if kind is int else "a number"
        raise SceneError(f"scene {scene}: {name} = {value!r}: must be {wanted}") from None
