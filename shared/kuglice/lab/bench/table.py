"""All cases of `kuglice bench`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from kuglice.lab.bench import copying, growth, memory, million, served, small, variety
from kuglice.lab.bench.case import Case, Contender, Measure, raced
from kuglice.lab.bench.stepping import OURS, stepping
from kuglice.lab.peers import PEERS
from kuglice.scenes import find

__all__ = ["cases"]

BALL_STEPS = 1_000_000
"""Of one repeat, about: some tens of milliseconds for the fastest contender."""
SCENES = {
    "gas 100": "gas:n=100",
    "gas 1,000": "gas:n=1000",
    "gas 10,000": "gas:n=10000",
    "gas 100,000": "gas:n=100000",
    "mixed 10,000": "mixed:n=10000",
}
HEADLINE = "gas 10,000"
HEADLINE_PEERS = ("pymunk", "numba grid")
"""They run here in every bench: these are the ones to beat."""
LONG: Mapping[str, Measure] = {**memory.CASES, **growth.CASES, **million.CASES}
"""With a million balls in them: minutes."""
SHORT: Mapping[str, Measure] = {**small.CASES, **variety.CASES, **copying.CASES, **served.CASES}
LONG_REPEATS = 3


def cases(*, peers: bool, quick: bool, repeats: int) -> list[Case]:
    """In the order in which they run; `quick` leaves the largest scenes out."""
    found = []
    for name, text in SCENES.items():
        if quick and "100,000" in name:
            continue
        case = Case(name, lambda _: {}, repeats)
        case.measure = raced(partial(_scene_case, name, text, peers, case.left_out))
        found.append(case)
    found += [Case(name, measure, repeats) for name, measure in SHORT.items()]
    if not quick:
        found += [Case(name, measure, min(repeats, LONG_REPEATS)) for name, measure in LONG.items()]
    return found


def _scene_case(name: str, text: str, peers: bool, left_out: list[str]) -> Mapping[str, Contender]:
    scene = find(text)
    makes = dict(OURS)
    if peers:
        makes |= PEERS
    elif name == HEADLINE:
        makes |= {peer: PEERS[peer] for peer in HEADLINE_PEERS}
    ticks = max(2, min(1000, BALL_STEPS // len(scene.balls)))
    return stepping(scene, makes, ticks, left_out)
