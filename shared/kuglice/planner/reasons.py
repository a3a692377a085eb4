"""Why a model was chosen, in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kuglice.planner.candidates import DEEPEST, Candidate
from kuglice.planner.demand import demanded
from kuglice.planner.situation import Situation
from kuglice.scene import Scene

__all__ = ["reasons"]


def reasons(scene: Scene, now: Situation, chosen: Candidate, every: Sequence[Candidate]) -> Iterator[str]:
    """One per part, then what to expect, then what the scene should know."""
    model, expected = chosen.model, chosen.expected
    pins = scene.model
    why = {
        "integrator": _integrator(scene, chosen, every),
        "contacts": _contacts(scene, chosen, every),
        "substeps": _substeps(scene, now, chosen, every),
        "broadphase": _broadphase(now, model.broadphase),
    }
    for part, sentence in why.items():
        pinned = getattr(pins, part) is not None
        yield f"{part} {getattr(model, part)}: {'pinned by the scene.' if pinned else sentence}"
    if pins.smallest_node is not None:
        yield f"smallest_node {pins.smallest_node:g}: pinned by the scene."
    yield (
        f"expected error {expected.error:.2g} radii: root mean square over balls after {now.window:.2g} s"
        f" ({'one collision per ball' if now.rate * now.window >= 0.999 else 'few collide in that time'});"
        f" {demanded(scene):g} is demanded."
    )
    yield (
        f"expected cost {expected.cost_ms:.2g} ms per tick of {1000 * now.tick:.3g} ms:"
        f" one thread, measured on {expected.machine}."
    )
    yield from _warnings(scene, chosen)


def _integrator(scene: Scene, chosen: Candidate, every: Sequence[Candidate]) -> str:
    kinds = sorted({force.kind for force in scene.forces})
    if not kinds:
        return "without forces all integrators move balls along the same lines."
    if set(kinds) <= {"gravity", "thrust"} and chosen.model.integrator in ("verlet", "rk4"):
        return f"exact under {'uniform gravity' if kinds == ['gravity'] else 'forces that hold for a tick'}."
    if chosen.model.contacts == "event":
        return (
            f"event goes with no other, since it follows parabolas; accurate enough under {', '.join(kinds)}."
        )
    cheaper = [
        each
        for each in every
        if each.model.contacts == chosen.model.contacts
        and each.model.integrator != chosen.model.integrator
        and each.expected.cost_ms < chosen.expected.cost_ms
    ]
    said = f"the cheapest that is accurate enough under {', '.join(kinds)}"
    if cheaper:
        near = min(cheaper, key=lambda each: (each.expected.error, each.expected.drift))
        if near.expected.error > demanded(scene):
            said += (
                f"; for less, {near.model.integrator} comes to an error of {near.expected.error:.2g} radii"
            )
        elif near.expected.sinks:
            said += f"; with {near.model.integrator}, balls would gain or lose energy at every bounce"
        elif near.expected.drift > 0.0:
            said += (
                f"; {near.model.integrator} would change the energy by {near.expected.drift:.2g} in a minute"
            )
    return said + "."


def _contacts(scene: Scene, chosen: Candidate, every: Sequence[Candidate]) -> str:
    name, demand = chosen.model.contacts, demanded(scene)
    cheaper = [each for each in every if each.expected.cost_ms < chosen.expected.cost_ms]
    best: dict[str, Candidate] = {}
    for each in cheaper:
        other = each.model.contacts
        if other != name and (other not in best or _flaws(each) < _flaws(best[other])):
            best[other] = each
    if not best:
        return f"the cheapest treatment, and good enough for {demand:g} radii."
    refused: dict[str, list[str]] = {}
    for other, each in best.items():
        refused.setdefault(_refused(each, scene), []).append(other)
    return "; ".join(why.format(" or ".join(names)) for why, names in refused.items()) + "."


def _flaws(each: Candidate) -> tuple[bool, float]:
    return each.expected.sinks, each.expected.error


def _refused(each: Candidate, scene: Scene) -> str:
    """A sentence with a place for the names."""
    if each.expected.sinks:
        return "with {}, balls that come to rest would sink through what carries them"
    if each.expected.depth > DEEPEST and each.expected.error <= demanded(scene):
        return f"with {{}}, balls that weigh on each other sink {each.expected.depth:.2g} radii deep"
    if each.expected.tunnels and each.expected.error <= demanded(scene):
        return "with {}, the fastest ball could pass through others"
    return f"for less, {{}} comes to an error of {each.expected.error:.2g} radii"


def _substeps(scene: Scene, now: Situation, chosen: Candidate, every: Sequence[Candidate]) -> str:
    count = chosen.model.substeps
    moved = f"the mean ball moves {now.speed * now.tick / now.radius:.2g} radii in a tick"
    fewer = [
        each
        for each in every
        if (each.model.integrator, each.model.contacts) == (chosen.model.integrator, chosen.model.contacts)
        and each.model.substeps < count
    ]
    if not fewer:
        return f"{moved}, short enough."
    if fewer[-1].expected.tunnels:
        return f"{now.who} of {now.fastest:.3g} per second moves {now.share:.2g} radii in a tick."
    return f"{moved}; with fewer substeps the error would be {fewer[-1].expected.error:.2g} radii."


def _broadphase(now: Situation, name: str) -> str:
    if name == "brute":
        said = f"{now.balls} balls are few" if now.balls > 1 else "one ball is little"
        return f"{said}: testing every pair costs less than keeping a tree."
    count = "one ball" if now.balls == 1 else f"{now.balls} balls"
    return f"the cheapest for {count}{', and more may come' if now.open else ''}."


def _warnings(scene: Scene, chosen: Candidate) -> Iterator[str]:
    expected, demand = chosen.expected, demanded(scene)
    if expected.error > demand:
        yield f"warning: the pins miss the accuracy of {demand:g} radii."
    if expected.tunnels:
        yield "warning: with these pins the fastest balls may pass through others."
    least, most = expected.pile_ms
    if least > expected.cost_ms:
        yield (
            "warning: that is the cost at the start; once the balls lie, a tick takes about"
            f" {least:.2g} ms where they lie one deep and {most:.2g} ms two deep."
        )
    if scene.budget_ms is not None and max(expected.cost_ms, least) > scene.budget_ms:
        yield f"warning: the pins miss the budget of {scene.budget_ms:g} ms."
    if expected.sinks:
        yield (
            "warning: with these pins, balls that come to rest sink through walls and each other, in the end"
            ' out of the box; contacts "event" carries them.'
        )
    elif expected.depth > DEEPEST:
        yield (
            f"warning: balls that weigh on each other will sink up to {expected.depth:.2g} radii into each other;"
            ' accuracy "faithful", or contacts "event", prevents it.'
        )
