"""How fast and how strongly each force of a scene acts, for the error that an integrator makes of it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kuglice.plan.situation import Situation
from kuglice.scene import Scene

__all__ = ["Action", "actions"]


class Action(NamedTuple):
    """`kind`: what the force depends on. `rate` in 1/s, `amplitude` as a length."""

    kind: str
    rate: float
    amplitude: float


def actions(scene: Scene, now: Situation) -> list[Action]:
    """Of every force, at the balls' places at the start; of held inputs, the most that the scene allows."""
    movable = np.isfinite(scene.balls.mass)
    mass, position = scene.balls.mass[movable], scene.balls.position[movable]
    lightest = float(mass.min()) if len(mass) else 1.0
    found = []
    for force in scene.forces:
        match force.kind:
            case "gravity":
                found.append(_uniform(math.hypot(force.x, force.y), now))
            case "thrust":
                # Held for whole ticks, so constant within each.
                pushed = scene.players.mass if scene.players is not None else lightest
                found.append(_uniform((scene.limits.thrust or 0.0) / pushed, now))
            case "drag" if force.coefficient > 0:
                rate = force.coefficient / lightest
                found.append(Action("velocity", rate, now.speed / rate))
            case "spring" if force.stiffness > 0 and len(mass):
                apart = np.sqrt(((position - (force.x, force.y)) ** 2).sum(axis=1))
                amplitude = math.sqrt(float((apart * apart).mean()))
                found.append(Action("place", math.sqrt(force.stiffness / lightest), amplitude))
            case "attractor" if force.strength and len(mass):
                apart = np.sqrt(((position - (force.x, force.y)) ** 2).sum(axis=1))
                found.append(_attractor(abs(force.strength), force.softening, apart))
            case "attract" if scene.limits.attract:
                # A player may hold it anywhere, so right where it is strongest.
                place = np.array([force.softening / math.sqrt(2.0)])
                found.append(_attractor(scene.limits.attract, force.softening, place))
    return [action for action in found if action.rate > 0.0 and action.amplitude > 0.0]


def _uniform(acceleration: float, now: Situation) -> Action:
    return Action("uniform", 1.0 / now.window, acceleration * now.window * now.window)


def _attractor(strength: float, softening: float, apart: NDArray[np.float64]) -> Action:
    """Root mean square over balls of what each would have as an oscillator of its own."""
    cubed = (apart * apart + softening * softening) ** 1.5
    rate = np.sqrt(strength / cubed)
    # Errors go with a high power of the rate, so that the fastest orbits decide.
    weight = rate**4 / (rate**4).sum()
    amplitude = math.sqrt(
        float((weight * apart * apart).sum()) * float((rate**4).sum() / rate.max() ** 4 / len(rate))
    )
    return Action("place", float(rate.max()), amplitude)
