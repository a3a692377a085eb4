"""The small table that the planner reads: errors of contacts and integrators, and what a ball-step costs."""

from kuglice.lab.calibration.draw import draw
from kuglice.lab.calibration.measure import jobs

__all__ = ["draw", "jobs"]
