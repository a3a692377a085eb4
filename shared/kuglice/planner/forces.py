"""How fast and how strongly each force of a scene acts, for the error that an integrator makes of it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kuglice.planner.situation import Situation
from kuglice.scene import Scene

__all__ = ["Action", "actions"]

Floats = NDArray[np.float64]

SAMPLE = 200


class Action(NamedTuple):
    """`kind`: as in the table of errors. `rate` in 1/s, `amplitude` as a length: of single balls."""

    kind: str
    rate: Floats
    amplitude: Floats


def actions(scene: Scene, now: Situation) -> list[Action]:
    """Of every force, at the balls' places at the start; of held inputs, the most that the scene allows."""
    movable = np.flatnonzero(np.isfinite(scene.balls.mass))
    # A few hundred balls tell as much as a million.
    chosen = movable[:: max(1, len(movable) // SAMPLE)]
    mass, position = scene.balls.mass[chosen], scene.balls.position[chosen]
    found = []
    for force in scene.forces if len(chosen) else ():
        match force.kind:
            case "gravity":
                found.append(_uniform(math.hypot(force.x, force.y), now))
            case "thrust":
                # Held for whole ticks, so constant within each.
                pushed = scene.players.mass if scene.players is not None else float(mass.min())
                found.append(_uniform((scene.limits.thrust or 0.0) / pushed, now))
            case "drag" if force.coefficient > 0:
                rate = force.coefficient / mass
                found.append(Action("velocity", rate, now.speed / rate))
            case "spring" if force.stiffness > 0:
                apart = np.sqrt(((position - (force.x, force.y)) ** 2).sum(axis=1))
                found.append(Action("spring", np.sqrt(force.stiffness / mass), apart))
            case "attractor" if force.strength:
                apart = np.sqrt(((position - (force.x, force.y)) ** 2).sum(axis=1))
                found.append(_attractor(abs(force.strength), force.softening, apart))
            case "attract" if scene.limits.attract:
                # A player may hold it anywhere, so right where it is strongest.
                place = np.array([force.softening / math.sqrt(2.0)])
                found.append(_attractor(scene.limits.attract, force.softening, place))
    return [action for action in found if action.rate.min() > 0.0]


def _uniform(acceleration: float, now: Situation) -> Action:
    rate = 1.0 / now.window if acceleration else 0.0
    return Action("uniform", np.array([rate]), np.array([acceleration * now.window * now.window]))


def _attractor(strength: float, softening: float, apart: Floats) -> Action:
    """As if each ball were on a circle around it."""
    rate = np.sqrt(strength / (apart * apart + softening * softening) ** 1.5)
    return Action("orbit", rate, apart)
