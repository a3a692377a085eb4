"""Every pairing of integrator and contacts that is registered: the curves of the charts."""

from __future__ import annotations

from dataclasses import dataclass

from kuglice import _core
from kuglice.errors import ModelError
from kuglice.model import Model
from kuglice.scene import Scene

__all__ = ["Method", "distinct", "methods"]


@dataclass(frozen=True)
class Method:
    """How a tick is computed, apart from its length and the broadphase."""

    integrator: str
    contacts: str

    def __str__(self) -> str:
        return f"{self.integrator} x {self.contacts}"

    def model(self, *, substeps: int = 1, broadphase: str = "loose_quadtree") -> Model:
        """As a model."""
        return Model(
            integrator=self.integrator, contacts=self.contacts, substeps=substeps, broadphase=broadphase
        )


def methods() -> list[Method]:
    """All of them; a pairing that the core refuses is none."""
    found = []
    for contacts in _core.CONTACTS:
        for integrator in _core.INTEGRATORS:
            method = Method(integrator, contacts)
            try:
                method.model()
            except ModelError:
                continue
            found.append(method)
    return found


def distinct(scene: Scene) -> tuple[list[Method], str]:
    """Those whose bits differ in this scene, and what to say about the others ("" if there are none)."""
    every = methods()
    if scene.forces:
        return every, ""
    kept = [Method("verlet", contacts) for contacts in _core.CONTACTS]
    return kept, "without forces all integrators give the same bits: only verlet is drawn"
