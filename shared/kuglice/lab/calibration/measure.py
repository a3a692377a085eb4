"""The measurements of the planner's table."""

from __future__ import annotations

from functools import partial

import numpy as np

from kuglice import _core
from kuglice.lab.calibration.contact_error import contact_error
from kuglice.lab.calibration.cost import contact_costs, integrator_costs
from kuglice.lab.calibration.force_drift import SCENES, force_drift
from kuglice.lab.calibration.force_error import KINDS, force_error
from kuglice.lab.calibration.pile_cost import LAYERS, pile_cost
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.methods import Method
from kuglice.lab.rows import Row, Rows
from kuglice.lab.running import making
from kuglice.lab.stability_maps.crowd import sinking

__all__ = ["jobs"]

PACKINGS = (0.05, 0.3, 0.6)
MOVES = (0.0125, 0.025, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6)
STEPS = (1, 2, 4, 8, 16, 32, 64, 128, 256)
DRIFT_STEPS = (4, 8, 16, 32, 64)
COUNTS = (10, 20, 40, 80, 300, 1_000, 10_000, 100_000)
SEEDS = tuple(range(1, 13))
"""Errors of `backtrack` are rare and large: two hits in one tick."""
SINKING_SECONDS = 10.0


def jobs(effort: Effort, left_out: list[str]) -> list[Job]:
    """Errors per packing and integrator, costs per number of balls."""
    counts = COUNTS[:6] if effort.quick else COUNTS
    moves = MOVES[::2] if effort.quick else MOVES
    seeds = effort.seeds if effort.quick else SEEDS
    return [
        *(
            Job(
                f"errors of {contacts} at packing {packing:g}",
                partial(_contacts, contacts, packing, moves, seeds),
            )
            for contacts in _core.CONTACTS
            for packing in PACKINGS
        ),
        *(Job(f"errors of {name}", partial(_integrator, name)) for name in _core.INTEGRATORS),
        *(Job(f"sinking with {contacts}", partial(_sinking, contacts)) for contacts in _core.CONTACTS),
        *(
            Job(f"costs of {count:,} balls", partial(contact_costs, count, effort.repeats))
            for count in counts
        ),
        *(Job(f"cost of {layers:g} layers at rest", partial(_pile, layers)) for layers in LAYERS),
        Job("costs of integrators", partial(integrator_costs, effort.repeats)),
    ]


def _contacts(contacts: str, packing: float, moves: tuple[float, ...], seeds: tuple[int, ...]) -> Rows:
    return [
        {
            "kind": "contact error",
            "contacts": contacts,
            "packing": packing,
            "x": move,
            "value": error,
        }
        for move in moves
        # A tick that is longer than the window is not measured but extrapolated.
        if not np.isnan(error := contact_error(contacts, packing, move, seeds))
    ]


def _integrator(integrator: str) -> Rows:
    rows: list[Row] = []
    for kind in KINDS:
        for steps in STEPS:
            error = force_error(integrator, kind, steps)
            rows.append(
                {
                    "kind": "force error",
                    "integrator": integrator,
                    "force": kind,
                    "x": 1.0 / steps,
                    "value": error,
                }
            )
    for kind in SCENES:
        for steps in DRIFT_STEPS:
            drift = force_drift(integrator, kind, steps)
            rows.append(
                {"kind": "drift", "integrator": integrator, "force": kind, "x": 1.0 / steps, "value": drift}
            )
    return rows


def _sinking(contacts: str) -> Rows:
    depth = sinking(making(Method("verlet", contacts).model()), 0.3, SINKING_SECONDS)
    return [{"kind": "sinking", "contacts": contacts, "value": depth}]


def _pile(layers: float) -> Rows:
    # The others carry no pile.
    cost = pile_cost("event", layers)
    return [{"kind": "pile cost", "contacts": "event", "x": layers, "value": cost}]
