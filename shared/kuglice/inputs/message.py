"""Inputs as maps of values that msgpack knows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import TypeAdapter, ValidationError

from kuglice.errors import InputError
from kuglice.inputs.kinds import Input
from kuglice.schema.problems import told

__all__ = ["from_message", "to_message"]

ADAPTER: TypeAdapter[Input] = TypeAdapter(Input)


def to_message(given: Input) -> dict[str, Any]:
    """A map with `kind`, `client`, `sequence` and the numbers of the kind."""
    return given.model_dump()


def from_message(message: Mapping[str, Any]) -> Input:
    """Raises InputError that names key, value and bound for anything that is no input."""
    try:
        return ADAPTER.validate_python(message)
    except ValidationError as error:
        raise told(error, InputError, "input") from None
