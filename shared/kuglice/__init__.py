"""Colliding balls in the plane: bit-equal on every machine, interactive, and over a network."""

from __future__ import annotations

import importlib as _importlib
from types import ModuleType as _ModuleType
from typing import TYPE_CHECKING as _TYPE_CHECKING

from kuglice import errors, inputs, scenes
from kuglice.ball_states import BallStates
from kuglice.errors import KugliceError
from kuglice.inputs import Attract, Input, Join, Kick, Leave, Remove, Spawn, Thrust
from kuglice.model import Model
from kuglice.plan import plan
from kuglice.scene import (
    AttractForce,
    Attractor,
    Balls,
    Drag,
    Force,
    Gravity,
    InputLimits,
    ModelPins,
    PlayerRules,
    Scene,
    SpawnLimits,
    Spring,
    ThrustForce,
)
from kuglice.version import VERSION as _VERSION
from kuglice.world import World

if _TYPE_CHECKING:
    from kuglice import loop, picture, protocol, replay

__all__ = [
    "Attract",
    "AttractForce",
    "Attractor",
    "BallStates",
    "Balls",
    "Drag",
    "Force",
    "Gravity",
    "Input",
    "InputLimits",
    "Join",
    "Kick",
    "KugliceError",
    "Leave",
    "Model",
    "ModelPins",
    "PlayerRules",
    "Remove",
    "Scene",
    "Spawn",
    "SpawnLimits",
    "Spring",
    "Thrust",
    "ThrustForce",
    "World",
    "errors",
    "inputs",
    "loop",
    "picture",
    "plan",
    "protocol",
    "replay",
    "scenes",
]

__version__ = _VERSION

_LATER = ("loop", "picture", "protocol", "replay")
"""Modules that most programs never need: `kuglice.loop` imports on first use."""


def __getattr__(name: str) -> _ModuleType:
    if name in _LATER:
        return _importlib.import_module(f"kuglice.{name}")
    raise AttributeError(f"module 'kuglice' has no attribute {name!r}")


def __dir__() -> list[str]:
    """What a user is meant to find, whichever modules are imported by now."""
    return [*__all__, "__version__"]
