"""How much energy an integrator makes or loses in the long run, per radian (or per fall), by step.

On a spring, and under gravity above an elastic floor: explicit Euler gains in both; symplectic Euler keeps the
first and loses in the second, because the flip at the floor changes the Hamiltonian that it conserves.
"""

from __future__ import annotations

from kuglice.model import Model
from kuglice.scene import Balls, Gravity, Scene, Spring
from kuglice.world import World

__all__ = ["SCENES", "force_drift"]

LONG = 400
"""Radians, or times of fall from height 1 at g = 1."""
SCENES = {
    "spring": (Spring(0.0, 1.0, 1.0), (-9.0, -9.0, 9.0, 9.0)),
    "uniform": (Gravity(0.0, -1.0), (-9.0, -0.1, 9.0, 9.0)),
}


def force_drift(integrator: str, kind: str, steps: int) -> float:
    """Change of energy per radian, relative to that at the start, with `steps` steps in each.

    Mean energies of the first and the last tenth are compared: what only swings to and fro is no drift.
    """
    force, box = SCENES[kind]
    scene = Scene(
        box=box,
        tick_rate=float(steps),
        forces=(force,),
        balls=Balls(position=[(0.0, 0.1 if kind == "spring" else 1.0)], radius=0.1, mass=1.0),
    )
    world = World(scene, Model(integrator=integrator, contacts="overlap", broadphase="brute"))
    start = world.energy
    tenth = LONG * steps // 10
    energies = []
    for part in range(10):
        mean = 0.0
        for _ in range(tenth):
            world.step()
            mean += world.energy / tenth
            if not mean < 1e6 * start:
                return mean / start / (LONG * (part + 1) / 10)
        energies.append(mean)
    return abs(energies[-1] - energies[0]) / start / (0.9 * LONG)
