"""Worlds in one line: a few balls, a box that is out of the way unless asked for, one choice of methods."""

from __future__ import annotations

from collections.abc import Sequence

import kuglice as kg

FAR = (-1e3, -1e3, 1e3, 1e3)
"""A box without walls still gives the trees their root."""


def make(
    position: object,
    velocity: object = (0.0, 0.0),
    *,
    radius: object = 0.5,
    mass: object = 1.0,
    forces: Sequence[object] = (),
    box: tuple[float, float, float, float] | None = None,
    restitution: float = 1.0,
    tick_rate: float = 60.0,
    allow_overlap: bool = False,
    integrator: str = "verlet",
    contacts: str = "event",
    broadphase: str = "loose_quadtree",
    substeps: int = 1,
) -> kg.World:
    """With a box there are walls."""
    scene = kg.Scene(
        box=FAR if box is None else box,
        walls=box is not None,
        restitution=restitution,
        tick_rate=tick_rate,
        forces=forces,
        balls=kg.Balls(position=position, velocity=velocity, radius=radius, mass=mass),
        allow_overlap=allow_overlap,
    )
    model = kg.Model(integrator=integrator, contacts=contacts, broadphase=broadphase, substeps=substeps)
    return kg.World(scene, model)
