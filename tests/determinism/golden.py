"""Golden hashes: what they are taken from, and how they are kept."""

from __future__ import annotations

import json
from pathlib import Path

import kuglice as kg
from determinism.flying import flight, trail
from determinism.models import named, pairings
from determinism.small_scenes import NAMES, small
from kuglice import _core

FILE = Path(__file__).with_name("golden.json")
TICKS = 240

Hashes = dict[str, list[str]]
"""Scene and model -> the state hash at the start, and after a third, two thirds and all of TICKS."""


class RefusedError(Exception):
    """Golden hashes would be lost to a change that STEP_VERSION knows nothing of."""


def runs() -> list[tuple[str, kg.Model]]:
    """Every small scene under every pairing."""
    return [(name, model) for name in NAMES for model in pairings()]


def label(name: str, model: kg.Model) -> str:
    """Key of a run in the file."""
    return f"{name} {named(model)}"


def hashes(name: str, model: kg.Model) -> list[str]:
    """Those of one run."""
    scene = small(name)
    world = kg.World(scene, model)
    start = world.state_hash
    flown = trail(world, flight(scene, TICKS))
    third = TICKS // 3
    return [f"{value:016x}" for value in (start, flown[third - 1], flown[2 * third - 1], flown[-1])]


def stored(file: Path = FILE) -> tuple[int, Hashes]:
    """STEP_VERSION of the file and its hashes; none where there is no file."""
    if not file.exists():
        return 0, {}
    content = json.loads(file.read_text())
    return content["step_version"], {key: line.split() for key, line in content["hashes"].items()}


def mint(fresh: Hashes, file: Path = FILE, *, force: bool = False) -> list[str]:
    """Write `fresh` and return the labels that are new or changed.

    Runs may be added at any time. Raises RefusedError if one would change or vanish under one STEP_VERSION.
    """
    version, old = stored(file)
    lost = [key for key, golden in old.items() if fresh.get(key) != golden]
    if lost and version == _core.STEP_VERSION and not force:
        raise RefusedError(
            f"{len(lost)} golden hashes would go, first {lost[0]!r}, and STEP_VERSION is still {version}:"
            " raise it if the step was meant to change, or say --force if only the scene was"
        )
    lines = {key: " ".join(fresh[key]) for key in sorted(fresh)}
    content = {"step_version": _core.STEP_VERSION, "hashes": lines}
    file.write_text(json.dumps(content, indent=1) + "\n")
    return [key for key, values in fresh.items() if old.get(key) != values]
