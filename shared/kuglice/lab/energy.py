"""Energy of a scene in motion, for worlds and peers alike."""

from __future__ import annotations

import numpy as np

from kuglice.lab.running import Running
from kuglice.scene import Scene

__all__ = ["conserved", "energy"]

CONSERVATIVE = frozenset({"gravity", "attractor", "spring"})


def conserved(scene: Scene) -> bool:
    """Whether energy should stay."""
    return scene.restitution == 1.0 and all(force.kind in CONSERVATIVE for force in scene.forces)


def energy(scene: Scene, running: Running) -> float:
    """Kinetic, and potential of gravity, springs and attractors; pegs left out."""
    movable = np.isfinite(scene.balls.mass)
    mass, place = scene.balls.mass[movable], running.position[movable]
    velocity = running.velocity[movable]
    total = 0.5 * float(mass @ (velocity * velocity).sum(1))
    for force in scene.forces:
        match force.kind:
            case "gravity":
                total -= float(mass @ (place @ np.array([force.x, force.y])))
            case "spring":
                total += 0.5 * force.stiffness * float(((place - (force.x, force.y)) ** 2).sum())
            case "attractor":
                squared = ((place - (force.x, force.y)) ** 2).sum(1)
                total -= force.strength * float(mass @ (1.0 / np.sqrt(squared + force.softening**2)))
    return total
