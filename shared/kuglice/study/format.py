"""The file: records (replay/framing.py) in the order in which things happened to a client.

    joined    versions, scene, model, name, number and epoch, tick and snapshot that it began with; again after a
              restart of the server
    tick      authoritative tick n was stepped: inputs(n) as packed records, hash of state(n + 1) if the server told it
    state     the server's state(n) was taken in place of one's own
    acted     an own input was made: sequence number, tick that it was meant for, packed record
    answered  what became of it: tick that it acts in (none: refused), ticks that it came early (negative: late)
    rollback  a guess was wrong: first and last tick of what was predicted again
    frame     a frame was drawn: between state(tick - 1) and state(tick), `alpha` of the way; `confirmed` is the
              tick of the authoritative state at that time. Some have `seen`, where balls were drawn, corrections that
              glide included: x and y of each as little-endian float32, in the order of the last `ids` (uint64); and
              the hash of the predicted state(tick)

`at`: seconds of a clock that goes evenly, and is the same for all processes of one machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

from kuglice.replay.framing import read_records
from kuglice.schema.numbers import Fraction, Number, Positive, Whole

__all__ = [
    "MAGIC",
    "Acted",
    "Answered",
    "DrawnFrame",
    "Event",
    "Joined",
    "Rollback",
    "State",
    "Tick",
    "read_study",
]

MAGIC = b"kuglice study 1\n"

Hash = Annotated[Whole, Field(le=2**64 - 1)]


class _Event(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    at: Number


class Joined(_Event):
    """In a world, from now on."""

    kind: Literal["joined"] = "joined"
    version: str
    step_version: Whole
    name: str | None
    number: Whole | None
    epoch: Whole
    rate: Positive
    scene: dict[str, Any]
    model: dict[str, Any]
    tick: Whole
    state: bytes


class Tick(_Event):
    """Confirmed."""

    kind: Literal["tick"] = "tick"
    tick: Whole
    inputs: bytes
    hash: Hash | None


class State(_Event):
    """Taken from the server."""

    kind: Literal["state"] = "state"
    tick: Whole
    data: bytes


class Acted(_Event):
    """An own input."""

    kind: Literal["acted"] = "acted"
    sequence: Whole
    tick: Whole
    input: bytes


class Answered(_Event):
    """An own input's outcome."""

    kind: Literal["answered"] = "answered"
    sequence: Whole
    tick: Whole | None
    early: int | None


class Rollback(_Event):
    """Ticks [first, end) were predicted wrong."""

    kind: Literal["rollback"] = "rollback"
    first: Whole
    end: Whole


class DrawnFrame(_Event):
    """What the eye saw."""

    kind: Literal["frame"] = "frame"
    tick: Whole
    alpha: Fraction
    confirmed: Whole
    hash: Hash | None = None
    ids: bytes | None = None
    seen: bytes | None = None


Event = Joined | Tick | State | Acted | Answered | Rollback | DrawnFrame
ADAPTER: TypeAdapter[Event] = TypeAdapter(Annotated[Event, Field(discriminator="kind")])


def read_study(path: Path) -> Iterator[Event]:
    """Every whole record. Raises ReplayError for a file that is no study, or damaged before its end."""
    return read_records(path, magic=MAGIC, noun="study", adapter=ADAPTER)
