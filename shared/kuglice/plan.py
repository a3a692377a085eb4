"""The planner: the cheapest model that meets what a scene demands, with its reasons in words."""

from __future__ import annotations

import math

from kuglice import _core
from kuglice.errors import ModelError, PlanError
from kuglice.model import Model
from kuglice.scene import Scene
from kuglice.travel import longest_travel

__all__ = ["plan"]

FEW_BALLS = 32
"""Up to here, testing every pair costs less than keeping a tree."""
BY_PLACE = frozenset({"attractor", "spring", "attract"})
"""Forces whose acceleration depends on where a ball is."""
MOST_SUBSTEPS = 16
LEVELS = {"visual": 0.1, "faithful": 1e-3, "exact": 0.0}
"""Accuracy in words as an error of position in radii."""
EXACT = 1e-6
"""Demands below this are met by exact times of contact only."""


def plan(scene: Scene) -> Model:
    """Choose integrator, contacts, substeps and broadphase; what the scene pins, wins.

    Raises PlanError if no registered method meets the demand, ModelError if pinned parts do not go together.
    """
    demand = LEVELS.get(scene.accuracy, 0.0) if isinstance(scene.accuracy, str) else scene.accuracy
    pins = scene.model
    contacts, why_contacts = _contacts(demand, pins.contacts)
    integrator, why_integrator = _paired(contacts, *_integrator(scene, demand))
    substeps, why_substeps = _substeps(scene, contacts)
    broadphase, why_broadphase = _broadphase(scene)
    chosen = {
        "integrator": (pins.integrator, integrator, why_integrator),
        "contacts": (pins.contacts, contacts, why_contacts),
        "substeps": (pins.substeps, substeps, why_substeps),
        "broadphase": (pins.broadphase, broadphase, why_broadphase),
    }
    reasons = [
        f"{part} {ours if pinned is None else pinned}: {why if pinned is None else 'pinned by the scene.'}"
        for part, (pinned, ours, why) in chosen.items()
    ]
    if pins.smallest_node is not None:
        reasons.append(f"smallest_node {pins.smallest_node:g}: pinned by the scene.")
    if scene.budget_ms is not None:
        reasons.append(f"budget {scene.budget_ms:g} ms: not checked, because no cost is measured in advance.")
    return Model(
        integrator=pins.integrator or integrator,
        contacts=contacts,
        substeps=pins.substeps or substeps,
        broadphase=pins.broadphase or broadphase,
        smallest_node=pins.smallest_node,
        reasons=tuple(reasons),
    )


def _integrator(scene: Scene, demand: float) -> tuple[str, str]:
    kinds = {force.kind for force in scene.forces}
    if not kinds:
        return (
            "euler",
            "without forces every integrator moves balls along the same lines, and it is the cheapest.",
        )
    if kinds == {"gravity"}:
        return "verlet", "it is exact under uniform gravity, for hardly more than the cost of Euler."
    varying = ", ".join(sorted(kinds - {"gravity"}))
    if demand < LEVELS["visual"] and not kinds & {"thrust", "attract"}:
        return "rk4", f"fourth order for accelerations that vary inside a tick ({varying})."
    if kinds & BY_PLACE:
        return (
            "verlet",
            f"second order, and its energy does not drift under forces that depend on place ({varying}).",
        )
    return "symplectic_euler", f"one evaluation of the forces ({varying}), enough for a visual accuracy."


def _paired(contacts: str, integrator: str, why: str) -> tuple[str, str]:
    """The integrator that is wanted, or the first that these contacts can be paired with."""
    for candidate in (integrator, *_core.INTEGRATORS):
        try:
            _core.Model(integrator=candidate, contacts=contacts, broadphase="brute")
        except ModelError:
            continue
        if candidate == integrator:
            return integrator, why
        return (
            candidate,
            f"contacts {contacts!r} are defined for its path between collisions, not for {integrator}.",
        )
    return integrator, why


def _contacts(demand: float, pinned: str | None) -> tuple[str, str]:
    if pinned is not None:
        return pinned, ""
    if demand >= LEVELS["visual"]:
        return "overlap", "pairs are tested after the move, which the eye cannot tell from the exact time."
    wanted = "event" if demand < EXACT else "backtrack"
    if wanted in _core.CONTACTS:
        return (
            wanted,
            f"an error of at most {demand:g} radii needs collisions at their times within the tick.",
        )
    raise PlanError(
        f"accuracy of {demand:g} radii needs contacts {wanted!r}; registered are {', '.join(_core.CONTACTS)}"
        f" (accuracy = {LEVELS['visual']:g} is met, and so is any if the scene pins contacts)"
    )


def _substeps(scene: Scene, contacts: str) -> tuple[int, str]:
    """As many as keep balls from moving farther than a radius between two tests."""
    if contacts == "event":
        return 1, "contacts 'event' miss no collision inside a tick."
    who, speed, share = longest_travel(scene)
    needed = max(1, math.ceil(share))
    moved = f"{who} of {speed:.3g} per second moves {share:.2g} radii in a tick"
    if needed > MOST_SUBSTEPS:
        most = f"{MOST_SUBSTEPS} is the most that is planned; a higher tick_rate helps"
        return MOST_SUBSTEPS, f"{moved}, and may pass through another; {most}."
    return needed, f"{moved}, and should not move more than one between two tests."


def _broadphase(scene: Scene) -> tuple[str, str]:
    count = len(scene.balls)
    if count <= FEW_BALLS and scene.limits.spawn is None and scene.players is None:
        return "brute", f"{count} balls are few: testing every pair costs less than keeping a tree."
    spread = float(scene.balls.radius.max() / scene.balls.radius.min()) if count else 1.0
    sizes = "of one size" if spread == 1.0 else f"of radii that differ {spread:.3g}-fold"
    return (
        "loose_quadtree",
        f"{count} balls {sizes}; each is kept at the level of its size, the fastest for many.",
    )
