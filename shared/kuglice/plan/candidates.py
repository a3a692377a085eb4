"""The models among which the planner chooses, each with what is expected of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kuglice import _core
from kuglice.errors import ModelError
from kuglice.model import Model
from kuglice.plan.demand import VISUAL, demanded
from kuglice.plan.expectation import Expectation, expect_in
from kuglice.plan.forces import actions
from kuglice.plan.situation import Situation
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
        sinks = demand < VISUAL and self.expected.depth > DEEPEST
        drifts = self.expected.drift > min(demand, MOST_DRIFT)
        return self.expected.error <= demand and not (self.expected.tunnels or sinks or drifts)


def candidates(scene: Scene, now: Situation) -> list[Candidate]:
    """All pairings with 1, 2, 4, ... substeps that the pins allow; ModelError if they allow none."""
    pins = scene.model
    refused: ModelError | None = None
    acting = actions(scene, now)
    found = []
    for integrator, contacts in _pairings(scene):
        for substeps in [pins.substeps] if pins.substeps else _powers_of_two():
            parts = {"integrator": integrator, "contacts": contacts, "substeps": substeps} | _smallest_node(
                scene
            )
            try:
                models = [Model(**parts, broadphase=each) for each in _broadphases(scene, now)]
            except ModelError as error:
                refused = error
                break
            options = [Candidate(model, expect_in(scene, now, acting, model)) for model in models]
            # The broadphase changes what a step costs, never what it gives.
            found.append(min(options, key=lambda candidate: candidate.expected.cost_ms))
    if not found and refused is not None:
        raise refused
    return found


def _pairings(scene: Scene) -> Iterator[tuple[str, str]]:
    """Every pairing of names; those that the core refuses are dropped later."""
    pins = scene.model
    for contacts in [pins.contacts] if pins.contacts else _core.CONTACTS:
        for integrator in [pins.integrator] if pins.integrator else _core.INTEGRATORS:
            yield integrator, contacts


def _broadphases(scene: Scene, now: Situation) -> list[str]:
    if scene.model.broadphase:
        return [scene.model.broadphase]
    # Where balls may be added, few can become many.
    return [MANY] if now.open else list(_core.BROADPHASES)


def _smallest_node(scene: Scene) -> dict[str, float]:
    return {} if scene.model.smallest_node is None else {"smallest_node": scene.model.smallest_node}


def _powers_of_two() -> list[int]:
    return [2**power for power in range(MOST_SUBSTEPS.bit_length())]
