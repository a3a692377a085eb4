"""Colliding balls in the plane: bit-equal on every machine, interactive, and over a network."""

from __future__ import annotations

import importlib as _importlib
from typing import TYPE_CHECKING as _TYPE_CHECKING

from kuglice.version import VERSION as _VERSION

if _TYPE_CHECKING:
    from kuglice import errors, inputs, loop, picture, protocol, replay, scenes
    from kuglice.ball_states import BallStates
    from kuglice.errors import KugliceError
    from kuglice.inputs import Attract, Input, Join, Kick, Leave, Remove, Spawn, Thrust
    from kuglice.model import Model
    from kuglice.planner import plan
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
    from kuglice.world import World

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

_HOMES = {
    "ball_states": "BallStates",
    "errors": "KugliceError",
    "inputs": "Attract Input Join Kick Leave Remove Spawn Thrust",
    "model": "Model",
    "planner": "plan",
    "scene": "AttractForce Attractor Balls Drag Force Gravity InputLimits ModelPins PlayerRules Scene SpawnLimits "
    "Spring ThrustForce",
    "world": "World",
}
"""What comes from which module, which is imported on first use: numpy, pydantic and the compiled core take half a
second, and a command that is typed wrongly, or interrupted, needs none of them."""
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names.split()}


def __getattr__(name: str) -> object:
    home = _HOME_OF.get(name)
    if home is not None:
        found: object = getattr(_importlib.import_module(f"kuglice.{home}"), name)
    elif name in __all__:
        found = _importlib.import_module(f"kuglice.{name}")
    else:
        raise AttributeError(f"module 'kuglice' has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    """What a user is meant to find, whichever modules are imported by now."""
    return [*__all__, "__version__"]
