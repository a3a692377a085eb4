"""The same start, given to the core with its `event` contacts."""

from __future__ import annotations

import kuglice as kg
from oracle.layout import Start


def event_world(start: Start, tick_rate: float, broadphase: str = "loose_quadtree") -> kg.World:
    """A world of the public package; tick_rate a power of two keeps tick n at exactly n / tick_rate."""
    scene = kg.Scene(
        box=start.box,
        walls=start.walls,
        balls=kg.Balls(
            position=start.position, velocity=start.velocity, radius=start.radius, mass=start.mass
        ),
        forces=[kg.Gravity(x=start.gravity[0], y=start.gravity[1])] if any(start.gravity) else [],
        restitution=start.restitution,
        tick_rate=tick_rate,
    )
    return kg.World(scene, kg.Model(integrator="verlet", contacts="event", broadphase=broadphase))
