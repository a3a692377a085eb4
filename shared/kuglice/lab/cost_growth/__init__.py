"""What a ball-step costs as scenes grow: with number, tree height, spread of radii, and packing."""

from kuglice.lab.cost_growth.draw import draw
from kuglice.lab.cost_growth.measure import jobs

__all__ = ["draw", "jobs"]
