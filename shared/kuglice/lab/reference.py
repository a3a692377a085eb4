"""What errors are measured against, since the lab may not use the tests' arbitrary precision.

Without forces, and under uniform gravity, a run with `event` contacts is exact but for rounding, at any
length of tick. Under other forces the reference is the same with ticks FINER times shorter than the shortest
one measured, which divides its own error by FINER at least (first order, across hits under drag) and by the
square elsewhere; where nothing collides, it is rk4. tests/shared/lab holds it against tests/oracle.
"""

from __future__ import annotations

from kuglice.lab.methods import Method
from kuglice.scene import Scene
from kuglice.world import World

__all__ = ["FINER", "exact_between_hits", "reference", "seconds_until"]

FINER = 64
EXACT_SUBSTEPS = 3


def exact_between_hits(scene: Scene) -> bool:
    """Whether balls fly on parabolas."""
    return all(force.kind == "gravity" for force in scene.forces)


def reference(scene: Scene, *, collisions: bool = True, finer: int = FINER) -> World:
    """A world of this scene, at its own tick rate, that is as right as f64 and patience allow.

    The scene's tick is the shortest one that is measured against it.
    """
    if exact_between_hits(scene):
        # Cut differently from what is measured, or rounding would seem to be nothing at all.
        return World(scene, Method("verlet", "event").model(substeps=EXACT_SUBSTEPS))
    method = Method("verlet", "event") if collisions else Method("rk4", "overlap")
    return World(scene, method.model(substeps=finer))


def seconds_until(
    scene: Scene, collisions_per_ball: float, longest: float, grain: float
) -> tuple[float, int]:
    """When the mean ball has collided so often, in whole grains of time, and the collisions until then."""
    world = World(scene.model_copy(update={"tick_rate": 1.0 / grain}), Method("verlet", "event").model())
    wanted = collisions_per_ball * world.count / 2.0
    while world.time + 0.5 * grain < longest and world.collisions < wanted:
        world.step()
    return world.time, world.collisions
