"""Records in a file: a line of magic, then, for each, a length, a CRC-32 and a msgpack map with the key "kind".

They are only ever appended, so a crash loses what was not written yet and nothing else.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, TypeVar

import msgpack
from pydantic import BaseModel, TypeAdapter, ValidationError

from kuglice.errors import ReplayError
from kuglice.schema.problems import told

__all__ = ["read_records", "write_record"]

FRAME = struct.Struct("<II")
LARGEST = 512 * 1024 * 1024
"""Bytes of one record: a snapshot of several million balls."""

R = TypeVar("R")


def write_record(file: BinaryIO, record: BaseModel) -> None:
    """In one write, so that a crash cuts at most this record."""
    body = msgpack.packb(record.model_dump(exclude_defaults=False))
    file.write(FRAME.pack(len(body), zlib.crc32(body)) + body)


def read_records(path: Path, *, magic: bytes, noun: str, adapter: TypeAdapter[R]) -> Iterator[R]:
    """Every whole record; one that is cut off at the end of the file is left out.

    Raises ReplayError for a file that is no `noun`, or damaged before its end.
    """
    with path.open("rb") as file:
        if file.read(len(magic)) != magic:
            raise ReplayError(f"{path}: not a {noun} file: its first line is not {magic.decode().strip()!r}")
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
            yield _record(path, at, body, adapter)


def _record(path: Path, at: int, body: bytes, adapter: TypeAdapter[R]) -> R:
    try:
        return adapter.validate_python(msgpack.unpackb(body))
    except ValidationError as error:
        raise told(error, ReplayError, f"{path}: byte {at}") from None
    except (ValueError, msgpack.UnpackException) as error:
        raise ReplayError(f"{path}: byte {at}: not msgpack: {error}") from error
