"""Parts of the model that a scene insists on."""

from __future__ import annotations

from typing import Self

from pydantic import BaseModel, ConfigDict, model_validator

from kuglice.errors import SceneError
from kuglice.schema.numbers import Count, Positive
from kuglice.schema.problems import raises, refuse
from kuglice.schema.registered import unregistered

__all__ = ["ModelPins"]


@raises(SceneError)
class ModelPins(BaseModel):
    """Each part that is None is the planner's choice. Names: `_core.INTEGRATORS` and its neighbours."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    integrator: str | None = None
    contacts: str | None = None
    broadphase: str | None = None
    substeps: Count | None = None
    smallest_node: Positive | None = None

    @model_validator(mode="after")
    def _registered(self) -> Self:
        refuse("ModelPins", unregistered(self))
        return self
