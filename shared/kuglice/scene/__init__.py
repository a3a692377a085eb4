"""What is there and what it demands: the scene, as a schema, a file and a message."""

from kuglice.balls import Balls
from kuglice.scene.forces import AttractForce, Attractor, Drag, Force, Gravity, Spring, ThrustForce
from kuglice.scene.limits import InputLimits, SpawnLimits
from kuglice.scene.pins import ModelPins
from kuglice.scene.players import PlayerRules
from kuglice.scene.scene import Scene

__all__ = [
    "AttractForce",
    "Attractor",
    "Balls",
    "Drag",
    "Force",
    "Gravity",
    "InputLimits",
    "ModelPins",
    "PlayerRules",
    "Scene",
    "SpawnLimits",
    "Spring",
    "ThrustForce",
]
