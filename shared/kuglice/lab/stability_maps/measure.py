"""The measurements of the four maps."""

from __future__ import annotations

from functools import partial

import numpy as np

from kuglice import _core
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.methods import Method
from kuglice.lab.peers import PEERS
from kuglice.lab.rows import Row, Rows
from kuglice.lab.running import CannotRunError, Make, making
from kuglice.lab.stability_maps import crowd, oscillator, tunnelling
from kuglice.scenes import gas

__all__ = ["jobs"]

PACKINGS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
SECONDS = 20.0
PEER = "pymunk"


def jobs(effort: Effort, left_out: list[str]) -> list[Job]:
    """One per curve; the crowd one per packing."""
    steps = [float(step) for step in np.linspace(0.05, 3.2, 22 if effort.quick else 64)]
    moves = [float(move) for move in np.geomspace(0.2, 100.0, 13 if effort.quick else 40)]
    makes: dict[str, Make] = {name: making(Method("verlet", name).model()) for name in _core.CONTACTS}
    if effort.peers:
        try:
            PEERS[PEER](gas(n=2))
            makes[PEER] = PEERS[PEER]
        except CannotRunError as reason:
            left_out.append(f"stability_maps: without {PEER}: {reason}")
    seconds = SECONDS / 10.0 if effort.quick else SECONDS
    return [
        *(Job(f"{name} on a spring", partial(_oscillator, name, steps)) for name in _core.INTEGRATORS),
        *(Job(f"tunnelling with {name}", partial(_tunnelling, name, moves)) for name in _core.CONTACTS),
        *(
            Job(f"a crowd at packing {packing:g}", partial(_crowd, makes, packing, seconds))
            for packing in (PACKINGS[1::3] if effort.quick else PACKINGS)
        ),
    ]


def _oscillator(integrator: str, steps: list[float]) -> Rows:
    return [
        {
            "map": "oscillator",
            "method": integrator,
            "x": step,
            "value": oscillator.growth(integrator, step),
            "theory": oscillator.theory(integrator, step),
        }
        for step in steps
    ]


def _tunnelling(contacts: str, moves: list[float]) -> Rows:
    return [
        {
            "map": "tunnelling",
            "method": contacts,
            "x": move,
            "value": tunnelling.share(contacts, move),
            "theory": tunnelling.theory(move),
            "seeds": "1",
        }
        for move in moves
    ]


def _crowd(makes: dict[str, Make], packing: float, seconds: float) -> Rows:
    rows: list[Row] = []
    for name, make in makes.items():
        for kind, measure in (("drift", crowd.drift), ("sinking", crowd.sinking)):
            value = measure(make, packing, seconds)
            rows.append({"map": kind, "method": name, "x": packing, "value": value, "seeds": "1"})
    return rows
