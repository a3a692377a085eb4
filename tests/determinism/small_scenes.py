"""Every built-in scene at a size that can be run many times over, and one scene in which every force acts."""

from __future__ import annotations

import numpy as np

import kuglice as kg
from kuglice import _core

BUILT_IN = {
    "gas": "gas:n=150,packing=0.5",
    "rain": "rain:n=200",
    "break": "break:rows=14",
    "cradle": "cradle",
    "orbit": "orbit",
    "pegs": "pegs:n=120,rows=8",
    "mixed": "mixed:n=150",
    "dam": "dam:n=400",
    "arena": "arena:balls=150",
}
NAMES = (*BUILT_IN, "everything")


def everything() -> kg.Scene:
    """Unequal radii and masses, a peg, inelastic contacts, all forces, players."""
    columns, rows = 9, 7
    grid = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2).astype(float)
    position = 1.0 + 2.0 * grid
    count = len(position)
    radius = 0.2 + 0.75 * _core.random_uniform(7, 0, 0, count)
    velocity = 8.0 * (_core.random_uniform(7, 1, 0, 2 * count).reshape(-1, 2) - 0.5)
    mass = 3.0 * radius * radius
    mass[count // 2], velocity[count // 2] = np.inf, 0.0
    return kg.Scene(
        title="everything",
        box=(0.0, 0.0, 2.0 * columns, 2.0 * rows),
        restitution=0.9,
        balls=kg.Balls(position=position, velocity=velocity, radius=radius, mass=mass),
        forces=[
            kg.Gravity(0.0, -9.81),
            kg.Drag(0.1),
            kg.Attractor(9.0, 7.0, 30.0, 0.5),
            kg.Spring(4.0, 4.0, 0.3),
            kg.ThrustForce(),
            kg.AttractForce(0.5),
        ],
    )


def small(name: str) -> kg.Scene:
    """The scene of a name in NAMES."""
    return everything() if name == "everything" else kg.scenes.find(BUILT_IN[name])
