"""Every pairing of integrator and contacts that is registered."""

from __future__ import annotations

import kuglice as kg
from kuglice import _core


def pairings(broadphase: str = "loose_quadtree") -> list[kg.Model]:
    """All of them; a pairing that the core refuses is not one."""
    found = []
    for integrator in _core.INTEGRATORS:
        for contacts in _core.CONTACTS:
            try:
                found.append(kg.Model(integrator=integrator, contacts=contacts, broadphase=broadphase))
            except kg.errors.ModelError:
                continue
    return found


def named(model: kg.Model) -> str:
    """For test ids and golden hashes."""
    return f"{model.integrator}-{model.contacts}"
