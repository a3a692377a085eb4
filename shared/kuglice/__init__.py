"""Colliding balls in the plane: bit-equal on every machine, interactive, and over a network."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from kuglice import errors, inputs, scenes
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
from kuglice.version import VERSION
from kuglice.world import World

__all__ = [
    "Attract",
    "AttractForce",
    "Attractor",
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
    "plan",
    "scenes",
]

__version__ = VERSION

LATER = ("loop", "picture", "protocol", "replay")
"""Modules that most programs never need: `kuglice.loop` imports on first use."""


def __getattr__(name: str) -> ModuleType:
    if name in LATER:
        return import_module(f"kuglice.{name}")
    raise AttributeError(f"module 'kuglice' has no attribute {name!r}")
