"""All cases of `kuglice bench`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from kuglice.lab.bench import copying, million, small
from kuglice.lab.bench.case import Case, Contender, stepping
from kuglice.lab.peers import PEERS
from kuglice.lab.running import Make, making
from kuglice.model import Model
from kuglice.scene import Balls, Scene
from kuglice.scenes import find
from kuglice.world import World

__all__ = ["cases"]

OURS: Mapping[str, Make] = {
    contacts: making(Model(integrator="verlet", contacts=contacts))
    for contacts in ("overlap", "backtrack", "event")
}
BALL_STEPS = 1_000_000
"""Of one repeat, about: some tens of milliseconds for the fastest contender."""
SCENES = {
    "gas 100": "gas:n=100",
    "gas 1,000": "gas:n=1000",
    "gas 10,000": "gas:n=10000",
    "gas 100,000": "gas:n=100000",
    "gas 1,000,000": "gas:n=1000000",
    "rain 10,000": "rain:n=10000,radius=0.08",
    "mixed 10,000": "mixed:n=10000",
}
SETTLED = {"rain 10,000": 4.0}
"""Seconds, by `event`, before the race: at first rain meets nothing but air."""
HEADLINE = "gas 10,000"
"""pymunk runs here in every bench: it is the one to beat."""


def cases(*, peers: bool, quick: bool, repeats: int) -> list[Case]:
    """In the order in which they run; `quick` leaves the largest scenes out."""
    found = []
    for name, text in SCENES.items():
        if quick and ("00,000" in name and name != HEADLINE):
            continue
        case = Case(name, lambda: {}, repeats)
        case.make = partial(_scene_case, name, text, peers, case.left_out)
        found.append(case)
    others = {**small.CASES, **copying.CASES, **({} if quick else million.CASES)}
    found += [Case(name, make, repeats) for name, make in others.items()]
    return found


def _scene_case(name: str, text: str, peers: bool, left_out: list[str]) -> Mapping[str, Contender]:
    scene = _settled(find(text), SETTLED.get(name, 0.0))
    makes = dict(OURS)
    if name == HEADLINE or (peers and len(scene.balls) < 1_000_000):
        makes |= PEERS if peers else {"pymunk": PEERS["pymunk"]}
    ticks = max(2, min(1000, BALL_STEPS // len(scene.balls)))
    return stepping(scene, makes, ticks, left_out)


def _settled(scene: Scene, seconds: float) -> Scene:
    if not seconds:
        return scene
    world = World(scene, Model(integrator="verlet", contacts="event"))
    world.run(round(seconds * scene.tick_rate))
    balls = Balls(position=world.position, velocity=world.velocity, radius=world.radius, mass=world.mass)
    # Rounding may leave a pair in touch by a last bit.
    return scene.model_copy(update={"balls": balls, "groups": (), "allow_overlap": True})
