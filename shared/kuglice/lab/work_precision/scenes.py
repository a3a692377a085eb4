"""Scenes that can tell methods apart.

Uniform gravity alone cannot rank Verlet and RK4, which are both exact between hits. So one scene has a force
that depends on place, one a force that depends on velocity, and one no collisions at all.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from kuglice.layout import RandomGroup
from kuglice.scene import Attractor, Drag, Scene
from kuglice.scenes import gas, orbit

__all__ = ["TABLE", "Subject", "subject"]


@dataclass(frozen=True)
class Subject:
    """A scene per seed, and for how long it is watched."""

    title: str
    make: Callable[[int], Scene]
    seconds: float = 60.0
    """Of the long run, in which energy and overlaps are watched."""
    window: float = 1.0
    """At most this many seconds until positions are compared; less where collisions end the prediction."""
    seeded: bool = True


def _swarm(seed: int) -> Scene:
    return Scene(
        title="Swarm",
        box=(-8.0, -8.0, 8.0, 8.0),
        forces=(Attractor(0.0, 0.0, 60.0, 2.0),),
        groups=(RandomGroup(count=100, radius=0.3, speed=3.0, seed=seed),),
    )


def _honey(seed: int) -> Scene:
    base = gas(n=100, seed=seed, speed=10.0)
    return base.model_copy(update={"title": "Drag", "forces": (Drag(1.5),)})


def _orbit(seed: int) -> Scene:
    return orbit()


TABLE: dict[str, Subject] = {
    "gas": Subject("Gas: 100 elastic balls, packing 0.30, no force", lambda seed: gas(n=100, seed=seed)),
    "swarm": Subject("Swarm: 100 elastic balls around an attractor", _swarm),
    "drag": Subject("Drag: 100 elastic balls in a viscous medium", _honey, seconds=3.0),
    "orbit": Subject("Orbit: 12 planets that never collide", _orbit, seeded=False),
}


def subject(scene: Scene) -> Subject:
    """Any scene: its balls are what they are, so that there is but one seed."""
    return Subject(scene.title or "Scene", lambda seed: scene, seconds=10.0, seeded=False)
