"""plan(scene): of all registered models, the cheapest that meets what the scene demands."""

from __future__ import annotations

from dataclasses import dataclass

from kuglice.errors import PlanError
from kuglice.model import Model
from kuglice.planner.candidates import MOST_SUBSTEPS, Candidate, candidates
from kuglice.planner.demand import demanded
from kuglice.planner.reasons import reasons
from kuglice.planner.situation import Situation, situation
from kuglice.scene import Scene

__all__ = ["NOISE", "plan"]

NOISE = 0.15
"""Share by which measured costs may differ without a meaning."""


@dataclass(frozen=True)
class Shortlist:
    """All candidates, by rising cost, and those of them that will do."""

    every: list[Candidate]
    meeting: list[Candidate]
    affordable: list[Candidate]


def plan(scene: Scene) -> Model:
    """Choose integrator, contacts, substeps and broadphase; what the scene pins, wins.

    Raises PlanError if no registered model meets the scene's accuracy within its budget, and says what comes
    closest; ModelError if pinned parts do not go together. A scene that pins a method gets the best that its pins
    allow, with a sentence about what they miss.
    """
    now = situation(scene)
    shortlist = _shortlist(scene, now)
    if shortlist.affordable:
        chosen = _best_of_cheapest(shortlist.affordable)
    elif _pinned(scene):
        chosen = _closest(scene, shortlist)
    else:
        raise PlanError(_nothing(scene, now, shortlist))
    return chosen.model.model_copy(update={"reasons": tuple(reasons(scene, now, chosen, shortlist.every))})


def _shortlist(scene: Scene, now: Situation) -> Shortlist:
    every = sorted(candidates(scene, now), key=lambda candidate: candidate.expected.cost_ms)
    meeting = [candidate for candidate in every if candidate.meets(scene)]
    affordable = [candidate for candidate in meeting if _within_budget(scene, candidate)]
    return Shortlist(every, meeting, affordable)


def _within_budget(scene: Scene, candidate: Candidate) -> bool:
    expected = candidate.expected
    return scene.budget_ms is None or max(expected.cost_ms, expected.pile_ms[0]) <= scene.budget_ms


def _best_of_cheapest(affordable: list[Candidate]) -> Candidate:
    """Costs that differ by less than NOISE are one cost, and then accuracy comes for nothing."""
    most = (1.0 + NOISE) * affordable[0].expected.cost_ms
    alike = [candidate for candidate in affordable if candidate.expected.cost_ms <= most]
    return min(alike, key=lambda candidate: (candidate.expected.drift > 0.0, candidate.expected.error))


def _pinned(scene: Scene) -> bool:
    pins = scene.model
    return any(part is not None for part in (pins.integrator, pins.contacts, pins.substeps, pins.broadphase))


def _closest(scene: Scene, shortlist: Shortlist) -> Candidate:
    """Within the budget if anything is; then the most accurate, but not for a trifle at any price."""
    within = [candidate for candidate in shortlist.every if _within_budget(scene, candidate)]
    if shortlist.meeting and not within:
        return shortlist.meeting[0]
    pool = within or shortlist.every
    able = [candidate for candidate in pool if not candidate.expected.sinks] or pool
    sound = [candidate for candidate in able if not candidate.expected.tunnels] or able
    best = min(candidate.expected.error for candidate in sound)
    return next(candidate for candidate in sound if candidate.expected.error <= 1.1 * best)


def _nothing(scene: Scene, now: Situation, shortlist: Shortlist) -> str:
    demand = demanded(scene)
    wanted = f"accuracy of {demand:g} radii"
    if not shortlist.meeting:
        closest = min(shortlist.every, key=lambda candidate: candidate.expected.error)
        return (
            f"{wanted}: no registered model meets it; {closest.model} comes closest with"
            f" {closest.expected.error:.2g} radii ({MOST_SUBSTEPS} substeps are the most); a higher tick_rate helps"
        )
    cheapest = shortlist.meeting[0]
    said = (
        f"{wanted} within a budget of {scene.budget_ms:g} ms per tick: no registered model meets both;"
        f" {cheapest.model} is the cheapest that is accurate enough, at {cheapest.expected.cost_ms:.2g} ms"
    )
    within = [candidate for candidate in shortlist.every if _within_budget(scene, candidate)]
    if within:
        best = min(within, key=lambda candidate: candidate.expected.error)
        said += f"; {best.model} keeps the budget with an error of {best.expected.error:.2g} radii"
    else:
        least = shortlist.every[0]
        said += (
            f"; nothing keeps the budget, {least.model} is the cheapest at {least.expected.cost_ms:.2g} ms"
        )
    return f"{said} (measured on {cheapest.expected.machine})"
