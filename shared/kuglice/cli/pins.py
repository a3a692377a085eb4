"""The options by which a command insists on parts of the model, as the table [model] of a scene does."""

from __future__ import annotations

from typing import Annotated

import typer

from kuglice import _core
from kuglice.scene import ModelPins, Scene

__all__ = ["Broadphase", "Contacts", "Integrator", "Substeps", "pinned"]

PLANNED = "[default: what the scene pins, else the planner's choice]"

Integrator = Annotated[
    str | None, typer.Option(help=f"How balls move: {', '.join(_core.INTEGRATORS)}. {PLANNED}")
]
Contacts = Annotated[
    str | None, typer.Option(help=f"How they collide: {', '.join(_core.CONTACTS)}. {PLANNED}")
]
Substeps = Annotated[int | None, typer.Option(help=f"Parts into which a tick is cut. {PLANNED}")]
Broadphase = Annotated[
    str | None,
    typer.Option(help=f"How pairs are found; same bits: {', '.join(_core.BROADPHASES)}. {PLANNED}"),
]


def pinned(
    scene: Scene,
    *,
    integrator: str | None,
    contacts: str | None,
    substeps: int | None,
    broadphase: str | None,
) -> Scene:
    """The scene with these pins over its own; None changes nothing. Raises SceneError for what is no such part."""
    given = {
        "integrator": integrator,
        "contacts": contacts,
        "substeps": substeps,
        "broadphase": broadphase,
    }
    chosen = {part: value for part, value in given.items() if value is not None}
    if not chosen:
        return scene
    return scene.model_copy(update={"model": ModelPins(**{**dict(scene.model), **chosen})})
