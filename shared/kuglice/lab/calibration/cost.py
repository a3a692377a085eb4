"""What a ball-step costs: by contacts, broadphase, balls and collisions; and what integrators add."""

from __future__ import annotations

from collections.abc import Mapping

from kuglice import _core
from kuglice.lab.rows import Row
from kuglice.lab.stopwatch import Timing, Work, race
from kuglice.model import Model
from kuglice.scene import Scene, Spring
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["BUSY", "contact_costs", "integrator_costs"]

BUSY = (0.05, 0.4)
"""Moves per tick, in radii, of a calm and of a busy gas: `event` pays per collision."""
BALL_STEPS = 100_000
MOST = {"brute": 3_000, "quadtree": 30_000}
SPRINGY = 1_000


def contact_costs(count: int, repeats: int) -> list[Row]:
    """One row per contacts, broadphase and busyness; x is the collisions per ball and tick."""
    rows: list[Row] = []
    for move in BUSY:
        scene = gas(n=count, radius=0.5, speed=30.0 * move)
        models = {
            f"{contacts} {broadphase}": Model(contacts=contacts, broadphase=broadphase)
            for contacts in _core.CONTACTS
            for broadphase in _core.BROADPHASES
            if count <= MOST.get(broadphase, count)
        }
        ticks = max(2, min(2000, BALL_STEPS // count))
        met: dict[str, float] = {}
        for name, timing in _race(scene, models, ticks, repeats, met).items():
            contacts, _, broadphase = name.partition(" ")
            rows.append(
                {
                    "kind": "cost",
                    "contacts": contacts,
                    "broadphase": broadphase,
                    "balls": count,
                    "x": met[name],
                    "value": timing.minimum * 1e9 / (ticks * count),
                }
            )
    return rows


def integrator_costs(repeats: int) -> list[Row]:
    """What each adds to a ball-step as soon as there is a force."""
    free = gas(n=SPRINGY)
    middle = (0.5 * free.box[2], 0.5 * free.box[3])
    bound = free.model_copy(update={"forces": (Spring(*middle, 0.01),)})
    ticks = BALL_STEPS // SPRINGY
    models = {name: Model(integrator=name, contacts="overlap") for name in _core.INTEGRATORS}
    plain = min(each.minimum for each in _race(free, models, ticks, repeats, {}).values())
    return [
        {
            "kind": "integrator cost",
            "integrator": name,
            "value": max(0.0, timing.minimum - plain) * 1e9 / BALL_STEPS,
        }
        for name, timing in _race(bound, models, ticks, repeats, {}).items()
    ]


def _race(
    scene: Scene, models: Mapping[str, Model], ticks: int, repeats: int, met: dict[str, float]
) -> dict[str, Timing]:
    """`met`: collisions per ball and tick are put there."""
    contenders = {}
    for name, model in models.items():
        warm, world = World(scene, model), World(scene, model)
        warm.run(2)
        world.copy_from(warm)
        world.run(ticks)
        met[name] = 2.0 * (world.collisions - warm.collisions) / (ticks * len(scene.balls))

        def prepare(warm: World = warm, world: World = world) -> Work:
            world.copy_from(warm)
            return lambda: world.run(ticks)

        contenders[name] = prepare
    return race(contenders, repeats)
