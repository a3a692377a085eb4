"""The models among which the planner chooses, each with what is expected of it."""

from __future__ import annotations

from dataclasses import dataclass

from kuglice import _core
from kuglice.errors import ModelError
from kuglice.model import Model
from kuglice.planner.demand import VISUAL, demanded
from kuglice.planner.expectation import Expectation, cost_ms, expect_in
from kuglice.planner.forces import actions
from kuglice.planner.situation import Situation
from kuglice.scene import Scene

__all__ = ["DEEPEST", "MOST_SUBSTEPS", "Candidate", "candidates"]

MOST_SUBSTEPS = 1024
MANY = "loose_quadtree"
"""The broadphase for any number of balls."""
DEEPEST = 0.5
"""Radii to which balls may sink into each other, for any demand below the visual one."""
MOST_DRIFT = 0.1
"""Share of its energy that a scene may gain or lose in a minute, for any demand."""


@dataclass(frozen=True)
class Candidate:
    """A model and what the table says about it in this scene."""

    model: Model
    expected: Expectation

    def meets(self, scene: Scene) -> bool:
        """Whether it is accurate enough; what it costs is another question."""
        demand = demanded(scene)
        expected = self.expected
        sinks = expected.sinks or (demand < VISUAL and expected.depth > DEEPEST)
        drifts = expected.drift > min(demand, MOST_DRIFT)
        return expected.error <= demand and not (expected.tunnels or sinks or drifts)


def candidates(scene: Scene, now: Situation) -> list[Candidate]:
    """All pairings with 1, 2, 4, ... substeps that the pins allow; ModelError if they allow none."""
    acting = actions(scene, now)
    found = []
    for model in _pairings(scene):
        for substeps in [scene.model.substeps] if scene.model.substeps else _powers_of_two():
            # A copy is not validated again: a power of two is as good as 1.
            cut = model.model_copy(update={"substeps": substeps})
            placed = _cheapest_broadphase(scene, now, cut)
            found.append(Candidate(placed, expect_in(scene, now, acting, placed)))
    return found


def _pairings(scene: Scene) -> list[Model]:
    """One model of each pairing that the core accepts."""
    pins = scene.model
    rest = pins.model_dump(include={"broadphase", "smallest_node", "substeps"}, exclude_none=True)
    refused: ModelError | None = None
    found = []
    for contacts in [pins.contacts] if pins.contacts else _core.CONTACTS:
        for integrator in [pins.integrator] if pins.integrator else _core.INTEGRATORS:
            try:
                found.append(Model(integrator=integrator, contacts=contacts, **rest))
            except ModelError as error:
                refused = error
    if not found and refused is not None:
        raise refused
    return found


def _cheapest_broadphase(scene: Scene, now: Situation, model: Model) -> Model:
    """It changes what a step costs, never what it gives. Where balls may be added, few can become many."""
    if scene.model.broadphase:
        return model
    names = [MANY] if now.open else _core.BROADPHASES
    able = [model.model_copy(update={"broadphase": name}) for name in names]
    return min(able, key=lambda each: cost_ms(scene, now, each))


def _powers_of_two() -> list[int]:
    return [2**power for power in range(MOST_SUBSTEPS.bit_length())]
