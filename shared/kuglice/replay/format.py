"""The file: a line of magic, then records of a length, a CRC-32 and a msgpack map with the key "kind".

    head   versions, scene, model, tick at the start, hash and state there
    tick   tick n, inputs(n) as packed records, hash of state(n + 1) or none, dt or none
    state  tick n, snapshot of state(n)
    end    tick and hash of the last state

Records are only ever appended, so a crash loses what was not written yet and nothing else.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, BinaryIO, Literal

import msgpack
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from kuglice.errors import ReplayError
from kuglice.schema.numbers import Count, Positive, Whole
from kuglice.schema.problems import told

__all__ = ["FORMAT", "MAGIC", "End", "Head", "Record", "State", "Tick", "read_records", "write_record"]

MAGIC = b"kuglice replay\n"
FORMAT = 1
FRAME = struct.Struct("<II")
LARGEST = 512 * 1024 * 1024
"""Bytes of one record: a snapshot of several million balls."""

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


def write_record(file: BinaryIO, record: BaseModel) -> None:
    """In one write, so that a crash cuts at most this record."""
    body = msgpack.packb(record.model_dump(exclude_defaults=False))
    file.write(FRAME.pack(len(body), zlib.crc32(body)) + body)


def read_records(path: Path) -> Iterator[Head | Tick | State | End]:
    """Every whole record; one that is cut off at the end of the file is left out.

    Raises ReplayError for a file that is no replay, or damaged before its end.
    """
    with path.open("rb") as file:
        if file.read(len(MAGIC)) != MAGIC:
            raise ReplayError(f"{path}: not a replay file: it does not start with {MAGIC!r}")
        while len(frame := file.read(FRAME.size)) == FRAME.size:
            at = file.tell() - FRAME.size
            length, checksum = FRAME.unpack(frame)
            if length > LARGEST:
                raise ReplayError(f"{path}: byte {at}: record of {length} bytes, at most {LARGEST}")
            body = file.read(length)
            if len(body) < length:
                return
            if zlib.crc32(body) != checksum:
                raise ReplayError(f"{path}: byte {at}: damaged: the checksum of the record does not match")
            yield _record(path, at, body)


def _record(path: Path, at: int, body: bytes) -> Head | Tick | State | End:
    try:
        return ADAPTER.validate_python(msgpack.unpackb(body))
    except ValidationError as error:
        raise told(error, ReplayError, f"{path}: byte {at}") from None
    except (ValueError, msgpack.UnpackException) as error:
        raise ReplayError(f"{path}: byte {at}: not msgpack: {error}") from error
