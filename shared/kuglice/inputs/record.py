"""Inputs as the fixed-size records that the compiled core reads."""

from __future__ import annotations

import struct
from collections.abc import Iterable
from typing import Any

from pydantic import ValidationError

from kuglice import _core
from kuglice.errors import InputError
from kuglice.inputs.kinds import KINDS, Input
from kuglice.schema.problems import told

__all__ = ["pack", "unpack"]

RECORD = struct.Struct("<BIQQ6d")
"""kind, client, sequence, ball, six numbers."""
NUMBERS: dict[str, tuple[str, ...]] = {
    "join": ("x", "y", "radius", "mass"),
    "leave": (),
    "spawn": ("x", "y", "vx", "vy", "radius", "mass"),
    "remove": (),
    "thrust": ("x", "y"),
    "attract": ("x", "y", "strength"),
    "kick": ("vx", "vy"),
}
PADDING = (0.0,) * 6
OF_THE_SERVER = tuple(_core.INPUT_KINDS.index(kind) for kind in ("join", "leave"))
"""Kinds written by the server for a client, under numbers that inputs of the client's own may have too."""
WITH_BALL = ("remove", "kick")
CLASSES: dict[str, Any] = {kind.model_fields["kind"].default: kind for kind in KINDS}


def pack(inputs: Iterable[Input]) -> bytes:
    """One record of `_core.INPUT_BYTES` bytes each, one after the other, in the order given.

    Raises InputError for anything that is no input.
    """
    if not isinstance(inputs, Iterable):
        raise InputError(f"inputs = {inputs!r}: must be a sequence of inputs")
    return b"".join(_record(given) for given in inputs)


def unpack(data: bytes) -> list[Input]:
    """What `pack` packed. Raises InputError for anything else, with the number of the record."""
    if len(data) % RECORD.size:
        raise InputError(f"input records: {len(data)} bytes, must be a multiple of {RECORD.size}")
    return [_input(index, *fields) for index, fields in enumerate(RECORD.iter_unpack(data))]


def _record(given: Input) -> bytes:
    if not isinstance(given, KINDS):
        raise InputError(f"input {given!r}: must be one of {', '.join(kind.__name__ for kind in KINDS)}")
    kind = given.kind
    ball = getattr(given, "ball", None)
    numbers = (*(getattr(given, name) for name in NUMBERS[kind]), *PADDING)[:6]
    try:
        return RECORD.pack(
            _core.INPUT_KINDS.index(kind),
            given.client,
            given.sequence,
            _core.NO_BALL if ball is None else ball,
            *numbers,
        )
    except struct.error as error:
        # A copy with other numbers is not validated by itself.
        raise InputError(
            f"{kind} {given.sequence} of client {given.client}: client must be below 2**32, sequence and ball below "
            f"2**64: {error}"
        ) from None


def _input(index: int, code: int, client: int, sequence: int, ball: int, *numbers: float) -> Input:
    if code >= len(_core.INPUT_KINDS):
        raise InputError(f"input record {index}: kind {code}, must be less than {len(_core.INPUT_KINDS)}")
    kind = _core.INPUT_KINDS[code]
    names = NUMBERS[kind]
    fields: dict[str, Any] = dict(zip(names, numbers, strict=False))
    if kind in WITH_BALL and ball != _core.NO_BALL:
        fields["ball"] = ball
    elif kind not in WITH_BALL and ball != _core.NO_BALL:
        raise InputError(f"input record {index}: {kind} names ball {ball}, must name none")
    if any(numbers[len(names) :]):
        raise InputError(f"input record {index}: {kind} with {6 - len(names)} unused numbers not 0")
    try:
        made: Input = CLASSES[kind].model_validate({"client": client, "sequence": sequence, **fields})
    except ValidationError as error:
        raise told(error, InputError, f"input record {index}, {kind}") from None
    return made
