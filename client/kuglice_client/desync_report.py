"""A desync as a file, for whoever looks for its cause: what differed first, in all its bits."""

from __future__ import annotations

import json
import logging
import struct
from pathlib import Path
from typing import Any

from kuglice import World, __version__, _core

__all__ = ["report", "write_report"]

log = logging.getLogger(__name__)

MAX_BALLS = 1_000
FIELDS = ("x", "y", "vx", "vy", "radius", "mass")


def report(ours: World, theirs: World, *, found_by: str, theirs_step_version: int) -> dict[str, Any]:
    """Values for JSON of two states of one tick; numbers as the 16 hexadecimal digits of their bits.

    At most MAX_BALLS balls, the lowest ids first; `differing` counts all.
    """
    here, there = _balls(ours), _balls(theirs)
    ids = sorted(ball for ball in here.keys() | there.keys() if here.get(ball) != there.get(ball))
    return {
        "first_tick": ours.tick,
        "found_by": found_by,
        "kuglice": __version__,
        "step_version": {"here": _core.STEP_VERSION, "there": theirs_step_version},
        "model": ours.model.to_message(),
        "state_hash": {"here": f"{ours.state_hash:016x}", "there": f"{theirs.state_hash:016x}"},
        "held": {"here": ours.held, "there": theirs.held},
        "players": {"here": ours.players, "there": theirs.players},
        "differing": len(ids),
        "balls": [{"id": ball, **_differences(here.get(ball), there.get(ball))} for ball in ids[:MAX_BALLS]],
    }


def write_report(
    directory: Path, ours: World, theirs: World, *, found_by: str, theirs_step_version: int
) -> Path | None:
    """The file, named after the tick; None, and a word in the log, if it cannot be written."""
    path = directory / f"desync-{ours.tick}.json"
    try:
        directory.mkdir(parents=True, exist_ok=True)
        number = 1
        while path.exists():
            number += 1
            path = directory / f"desync-{ours.tick}-{number}.json"
        values = report(ours, theirs, found_by=found_by, theirs_step_version=theirs_step_version)
        path.write_text(json.dumps(values, indent=2) + "\n")
    except OSError as error:
        log.error("desync report %s cannot be written: %s", path, error.strerror)
        return None
    log.error("desync report: %s", path)
    return path


def _balls(world: World) -> dict[int, dict[str, str]]:
    columns = [*world.position.T, *world.velocity.T, world.radius, world.mass]
    rows = zip(world.id.tolist(), *(column.tolist() for column in columns), strict=True)
    return {ball: dict(zip(FIELDS, map(_bits, numbers), strict=True)) for ball, *numbers in rows}


def _bits(number: float) -> str:
    return struct.pack(">d", number).hex()


def _differences(here: dict[str, str] | None, there: dict[str, str] | None) -> dict[str, Any]:
    if here is None or there is None:
        return {"only": "there" if here is None else "here", "bits": here or there}
    return {
        "bits": {
            name: {"here": here[name], "there": there[name]} for name in FIELDS if here[name] != there[name]
        }
    }
