"""Parts of the model that a scene insists on."""

from __future__ import annotations

from typing import Self

from pydantic import BaseModel, ConfigDict, model_validator

from kuglice import _core
from kuglice.errors import SceneError
from kuglice.schema.numbers import Count, Positive
from kuglice.schema.problems import Problem, raises, refuse

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
        tables = {
            "integrator": _core.INTEGRATORS,
            "contacts": _core.CONTACTS,
            "broadphase": _core.BROADPHASES,
        }
        refuse(
            "ModelPins",
            [
                Problem((part,), getattr(self, part), f"must be one of {', '.join(names)}")
                for part, names in tables.items()
                if getattr(self, part) not in (None, *names)
            ],
        )
        return self
