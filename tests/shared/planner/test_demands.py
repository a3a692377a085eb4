"""The planned model meets its accuracy, and no cheaper registered model does: judged by runs, not by the table."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

import kuglice as kg
from kuglice.errors import StepError
from kuglice.lab.energy import conserved, energy
from kuglice.lab.reference import reference, seconds_until
from kuglice.lab.work_precision.errors import position_error
from kuglice.layout import RandomGroup
from kuglice.planner import expect
from kuglice.planner.candidates import MOST_DRIFT, candidates
from kuglice.planner.choice import NOISE
from kuglice.planner.demand import LONGEST, demanded
from kuglice.planner.situation import situation


def swarm(seed: int) -> kg.Scene:
    """Balls around an attractor: a force that depends on place, and collisions."""
    return kg.Scene(
        box=(-8, -8, 8, 8),
        forces=[kg.Attractor(0.0, 0.0, 60.0, 2.0)],
        groups=[RandomGroup(count=100, radius=0.3, speed=3.0, seed=seed)],
    )


def falling(seed: int) -> kg.Scene:
    """A gas with a little weight."""
    return kg.scenes.gas(n=100, speed=8.0, seed=seed).model_copy(update={"forces": (kg.Gravity(0.0, -2.0),)})


SCENES = {
    "dilute gas": lambda seed: kg.scenes.gas(n=100, packing=0.1, seed=seed),
    "gas": lambda seed: kg.scenes.gas(n=100, packing=0.3, seed=seed),
    "dense gas": lambda seed: kg.scenes.gas(n=100, packing=0.55, seed=seed),
    "few balls": lambda seed: kg.scenes.gas(n=12, packing=0.3, seed=seed),
    "falling": falling,
    "swarm": swarm,
    "orbit": lambda seed: kg.scenes.orbit(),
}
CASES = [
    *[(name, "visual") for name in ("gas", "dense gas", "few balls", "falling", "swarm")],
    *[(name, "faithful") for name in ("dilute gas", "gas", "dense gas", "few balls", "falling", "swarm")],
    *[(name, "exact") for name in ("gas", "dense gas", "falling")],
]
# Nothing collides there, which no planner can know: it pays for collisions that might have been.
COLLISIONLESS = [("orbit", "faithful"), ("orbit", 1e-4)]
GRAIN = 1 / 256
SEEDS = 8
"""Errors are rare and large (two hits in one tick), so that one layout may be lucky."""


class Judge:
    """Runs models of a scene in several layouts and compares them with the reference."""

    def __init__(self, make: Callable[[int], kg.Scene]) -> None:
        layouts = SEEDS * max(1, 100 // len(make(1).balls))
        self.scenes = [make(seed) for seed in range(1, layouts + 1)]
        self.rights = [self.right(scene) for scene in self.scenes]

    @staticmethod
    def right(scene: kg.Scene) -> tuple[int, np.ndarray]:
        seconds, collisions = seconds_until(scene, 1.0, LONGEST, GRAIN)
        ticks = max(1, round(seconds * scene.tick_rate))
        world = reference(scene, collisions=collisions > 0, finer=512)
        world.run(ticks)
        return ticks, world.position

    def error(self, model: kg.Model) -> float:
        """Root mean square over balls and layouts, in radii."""
        squares = []
        for scene, (ticks, right) in zip(self.scenes, self.rights, strict=True):
            world = kg.World(scene, model)
            try:
                world.run(ticks)
            except StepError:
                return np.inf
            squares.append(position_error(world.position, right, scene.balls.radius) ** 2)
        return float(np.sqrt(np.mean(squares)))

    def drift(self, model: kg.Model, seconds: float = 60.0) -> float:
        """Relative change of energy in a minute."""
        scene = self.scenes[0]
        if not conserved(scene):
            return 0.0
        world = kg.World(scene, model)
        start = energy(scene, world)
        try:
            world.run(round(seconds * scene.tick_rate))
        except StepError:
            return np.inf
        return abs(energy(scene, world) / start - 1.0)


@cache
def judge(name: str) -> Judge:
    return Judge(SCENES[name])


def demanding(name: str, accuracy: str | float) -> kg.Scene:
    return SCENES[name](1).model_copy(update={"accuracy": accuracy})


@pytest.mark.parametrize(("name", "accuracy"), CASES + COLLISIONLESS)
def test_the_planned_model_is_accurate_enough(name, accuracy):
    scene = demanding(name, accuracy)
    model = kg.plan(scene)
    assert judge(name).error(model) <= demanded(scene), model


@pytest.mark.parametrize(("name", "accuracy"), CASES)
def test_no_cheaper_model_is(name, accuracy):
    scene = demanding(name, accuracy)
    planned = expect(scene, kg.plan(scene))
    cheaper = [
        each
        for each in candidates(scene, situation(scene))
        if each.expected.cost_ms * (1 + NOISE) < planned.cost_ms
        # Rare and late: test_balls_at_rest_stay_in_the_box and tests/stability run these.
        and not (each.expected.tunnels or each.expected.sinks)
    ]
    for each in cheaper:
        wrong = judge(name).error(each.model) > demanded(scene)
        drifts = wrong or judge(name).drift(each.model) > min(demanded(scene), MOST_DRIFT)
        assert wrong or drifts, (
            f"{each.model} would do, at {each.expected.cost_ms:.2g} of {planned.cost_ms:.2g} ms"
        )


@pytest.mark.parametrize("name", dict.fromkeys(name for name, _ in CASES))
@pytest.mark.parametrize(("contacts", "factor"), [("overlap", 3.0), ("backtrack", 10.0)])
def test_errors_are_not_far_from_what_is_expected(name, contacts, factor):
    for substeps in (1, 4):
        model = kg.Model(integrator="verlet", contacts=contacts, substeps=substeps)
        assert 1 / factor < expect(SCENES[name](1), model).error / judge(name).error(model) < factor, model
