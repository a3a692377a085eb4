"""What to expect of a model in a scene, read off the measured table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from kuglice.model import Model
from kuglice.planner import measured
from kuglice.planner.forces import Action, actions
from kuglice.planner.situation import Situation, situation
from kuglice.scene import Scene

__all__ = ["Expectation", "cost_ms", "expect", "expect_in"]

CONSERVATIVE = frozenset({"gravity", "attractor", "spring"})
MINUTE = 60.0
BEAT = np.array([0.1])
"""A step in times of fall, at which integrators that leak above a floor are told from those that do not."""
CONSERVES = 1e-9
"""Relative change of energy per time of fall that is rounding."""
MOST_MOVED = 1.0
"""Radii that any ball may move between two tests of contact. Two balls head-on then move 2, and still meet."""


@dataclass(frozen=True)
class Expectation:
    """`error`: position after one collision per ball or a second, in radii (see kuglice.planner.demand)."""

    error: float
    cost_ms: float
    """Per tick of the scene as it starts, on `machine`."""
    pile_ms: tuple[float, float]
    """The same once all balls lie, one and two deep; 0 if they never do, or sink."""
    tunnels: bool
    """Whether the fastest ball can pass through the smallest within a step."""
    depth: float
    """To which balls that weigh on each other sink, in radii; 0 if none do."""
    sinks: bool
    """Whether a ball that comes to rest sinks through what carries it, without bound: see `_sinks`."""
    drift: float
    """Relative change of energy in a minute, where energy should stay."""
    machine: str


def expect(scene: Scene, model: Model) -> Expectation:
    """Error and cost of a model in a scene. The table holds elastic balls; e below 1 is taken to be alike."""
    now = situation(scene)
    return expect_in(scene, now, actions(scene, now), model)


def expect_in(scene: Scene, now: Situation, acting: Sequence[Action], model: Model) -> Expectation:
    """The same for a situation and actions of forces that are known."""
    step = now.tick / model.substeps
    return Expectation(
        error=math.hypot(_contact_error(now, model, step), _force_error(now, acting, model, step)),
        cost_ms=cost_ms(scene, now, model),
        pile_ms=_pile_ms(now, model),
        tunnels=model.contacts != "event" and now.share > MOST_MOVED * model.substeps,
        depth=measured.sinking(model.contacts) if now.pressed else 0.0,
        sinks=_sinks(now, model),
        drift=_drift(scene, now, acting, model, step),
        machine=measured.machine(),
    )


def _sinks(now: Situation, model: Model) -> bool:
    """`overlap` and `backtrack` turn a velocity round and leave the place: nothing carries a ball that lies.

    Each step adds more to the speed inwards than the last impact sent back. Elastic balls never lie, but an
    integrator that loses energy above an elastic floor brings them to it, and one that gains there never stops.
    """
    if model.contacts == "event":
        return False
    leaks = float(measured.drift(model.integrator, "uniform", BEAT)[0]) > CONSERVES
    return now.settles or (now.carried and leaks)


def _contact_error(now: Situation, model: Model, step: float) -> float:
    move = now.speed * step / now.radius
    if not now.hits or not move:
        return 0.0
    # If but a share of the balls collides, the mean of squares is that share.
    return measured.contact_error(model.contacts, now.packing, move) * math.sqrt(now.hits)


def _force_error(now: Situation, acting: Sequence[Action], model: Model, step: float) -> float:
    """Errors of forces add up; each grows with the time that it acts. Root mean square over balls."""
    total = 0.0
    for kind, rate, amplitude in acting:
        errors = amplitude * measured.force_error(model.integrator, kind, rate * step) * rate * now.window
        total += math.sqrt(float((errors * errors).mean()))
    return total / now.radius


def _drift(scene: Scene, now: Situation, acting: Sequence[Action], model: Model, step: float) -> float:
    """Only forces by place and uniform ones conserve energy, and only if they are all that acts."""
    if not CONSERVATIVE.issuperset(force.kind for force in scene.forces) or scene.restitution < 1.0:
        return 0.0
    total = 0.0
    for kind, rate, _ in acting:
        # A uniform force has no rate of its own: its time is that of a fall.
        beat = np.array([max(now.fall_rate, 1e-9)]) if kind == "uniform" else rate
        table = "uniform" if kind == "uniform" else "spring"
        total += float((measured.drift(model.integrator, table, beat * step) * beat).mean()) * MINUTE
    return total


def _pile_ms(now: Situation, model: Model) -> tuple[float, float]:
    if not (now.pressed and now.settles):
        return 0.0, 0.0
    least, most = measured.pile_cost(model.contacts)
    each = now.moving * model.substeps * 1e-6
    return least * each, most * each


def cost_ms(scene: Scene, now: Situation, model: Model) -> float:
    """Of a tick."""
    step = now.tick / model.substeps
    each = measured.contacts_cost(model.contacts, model.broadphase, now.balls, now.rate * step)
    if scene.forces:
        each += measured.integrator_cost(model.integrator)
    return each * now.balls * model.substeps * 1e-6
