"""Contenders that step: a world of ours or a peer, each round from the same initial state."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from kuglice.lab.bench.case import Contender
from kuglice.lab.running import CannotRunError, Make, Running, making
from kuglice.lab.stopwatch import Work
from kuglice.model import Model
from kuglice.scene import Balls, Scene
from kuglice.world import World

__all__ = ["OURS", "contender", "settled", "stepping"]

OURS: Mapping[str, Make] = {
    contacts: making(Model(integrator="verlet", contacts=contacts))
    for contacts in ("overlap", "backtrack", "event")
}


def stepping(
    scene: Scene, makes: Mapping[str, Make], ticks: int, left_out: list[str]
) -> dict[str, Contender]:
    """All of them in one scene; who cannot run it is left out, with the reason."""
    found = {}
    for name, make in makes.items():
        try:
            found[name] = contender(scene, make, ticks)
        except CannotRunError as reason:
            left_out.append(f"{name}: {reason}")
    return found


def contender(scene: Scene, make: Make, ticks: int) -> Contender:
    """Runs the same `ticks` from the same initial state in every round. Raises CannotRunError."""
    ready = _ready(scene, make, max(1, ticks // 4))

    def prepare() -> Work:
        run = ready().run
        return lambda: run(ticks)

    return Contender(prepare, ticks * max(len(scene.balls), 1))


def settled(scene: Scene, seconds: float) -> Scene:
    """The scene as it is after so long, by `event`."""
    world = World(scene, Model(integrator="verlet", contacts="event"))
    world.run(round(seconds * scene.tick_rate))
    balls = Balls(position=world.position, velocity=world.velocity, radius=world.radius, mass=world.mass)
    # Rounding may leave a pair in touch by a last bit.
    return scene.model_copy(update={"balls": balls, "groups": (), "allow_overlap": True})


def _ready(scene: Scene, make: Make, warm: int) -> Callable[[], Running]:
    """Gives the world as it is after a few ticks, which fill caches and scratch memory."""
    world = make(scene)
    if isinstance(world, World):
        copy = world.clone()

        def again() -> Running:
            # Into the same memory: a fresh clone would pay for its first touch.
            copy.copy_from(world)
            copy.run(warm)
            return copy

        return again

    def rebuilt() -> Running:
        made = make(scene)
        made.run(warm)
        return made

    return rebuilt
