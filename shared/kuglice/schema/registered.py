"""Names of methods, held against what the compiled core has registered."""

from __future__ import annotations

from pydantic import BaseModel

from kuglice import _core
from kuglice.schema.problems import Problem

__all__ = ["unregistered"]

_TABLES = {
    "integrator": _core.INTEGRATORS,
    "contacts": _core.CONTACTS,
    "broadphase": _core.BROADPHASES,
}


def unregistered(given: BaseModel) -> list[Problem]:
    """A problem for each part of a model, or of a scene's pins, that names no method. None is no name."""
    return [
        Problem((part,), getattr(given, part), f"must be one of {', '.join(names)}")
        for part, names in _TABLES.items()
        if getattr(given, part) not in (None, *names)
    ]
