"""Model: what computes a scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from kuglice import _core
from kuglice.errors import ModelError
from kuglice.schema.numbers import Count, Positive
from kuglice.schema.problems import raises, refuse, told
from kuglice.schema.registered import unregistered

__all__ = ["Model"]


@raises(ModelError)
class Model(BaseModel):
    """One choice of each part, by its registered name; `reasons` are the planner's sentences.

    Raises ModelError for a name or a pairing that is not registered.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    integrator: str = "verlet"
    contacts: str = "overlap"
    broadphase: str = "loose_quadtree"
    substeps: Count = 1
    smallest_node: Positive | None = None
    """Side at which the leaves of a quadtree stop; None lets the core choose."""
    reasons: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _registered(self) -> Self:
        refuse("Model", unregistered(self))
        self.core()
        return self

    def core(self) -> _core.Model:
        """For the compiled core."""
        return _core.Model(
            integrator=self.integrator,
            contacts=self.contacts,
            broadphase=self.broadphase,
            substeps=self.substeps,
            smallest_node=self.smallest_node,
        )

    def to_message(self) -> dict[str, Any]:
        """Values that msgpack knows."""
        return self.model_dump(mode="json")

    @classmethod
    def from_message(cls, message: Mapping[str, Any]) -> Model:
        """Raises ModelError for anything that is not a valid model."""
        try:
            return cls.model_validate(message)
        except ValidationError as error:
            raise told(error, ModelError, "model message", cls.model_fields) from None

    def __str__(self) -> str:
        times = f" x {self.substeps}" if self.substeps > 1 else ""
        return f"{self.integrator} x {self.contacts}{times}, {self.broadphase}"
