"""The file: records (framing.py) of four kinds.

head   versions, scene, model, tick at the start, hash and state there
tick   tick n, inputs(n) as packed records, hash of state(n + 1) or none, dt or none
state  tick n, snapshot of state(n)
end    tick and hash of the last state
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

from kuglice.replay.framing import read_records
from kuglice.schema.numbers import Count, Positive, Whole

__all__ = ["FORMAT", "MAGIC", "End", "Head", "Record", "State", "Tick", "read_replay"]

MAGIC = b"kuglice replay\n"
FORMAT = 1

Hash = Annotated[Whole, Field(le=2**64 - 1)]
SCHEMA = ConfigDict(frozen=True, extra="forbid", strict=True)


class Head(BaseModel):
    """The first record."""

    model_config = SCHEMA

    kind: Literal["head"] = "head"
    format: Whole = FORMAT
    version: str
    """Of the package."""
    step_version: Whole
    scene: dict[str, Any]
    model: dict[str, Any]
    tick: Whole
    hash: Hash
    state: bytes | None
    """Snapshot at the start, unless it is the scene's own."""
    hash_every: Count


class Tick(BaseModel):
    """One per tick."""

    model_config = SCHEMA

    kind: Literal["tick"] = "tick"
    tick: Whole
    inputs: bytes = b""
    hash: Hash | None = None
    dt: Positive | None = None


class State(BaseModel):
    """Now and then, and at the end: what names the balls that differ."""

    model_config = SCHEMA

    kind: Literal["state"] = "state"
    tick: Whole
    data: bytes


class End(BaseModel):
    """The last record of a recording that was closed."""

    model_config = SCHEMA

    kind: Literal["end"] = "end"
    tick: Whole
    hash: Hash


Record = Annotated[Head | Tick | State | End, Field(discriminator="kind")]
ADAPTER: TypeAdapter[Head | Tick | State | End] = TypeAdapter(Record)


def read_replay(path: Path) -> Iterator[Head | Tick | State | End]:
    """Every whole record (framing.py). Raises ReplayError for a file that is no replay, or damaged before its end."""
    return read_records(path, magic=MAGIC, noun="replay", adapter=ADAPTER)
