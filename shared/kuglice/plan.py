"""The planner: the cheapest model that meets what a scene demands, with its reasons in words."""

from __future__ import annotations

from kuglice.model import Model
from kuglice.scene import Scene

__all__ = ["plan"]

FEW_BALLS = 32
"""Up to here every pair is tested faster than a tree is built."""
POSITION_FORCES = frozenset({"attractor", "spring", "attract"})
"""Forces whose acceleration depends on where the ball is."""


def plan(scene: Scene) -> Model:
    """Choose integrator, contacts and broadphase; what the scene pins, wins."""
    return Model()
