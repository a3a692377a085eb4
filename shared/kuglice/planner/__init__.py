"""The planner: the cheapest model that meets what a scene demands, with its reasons in words."""

from kuglice.planner.choice import plan
from kuglice.planner.demand import LEVELS
from kuglice.planner.expectation import Expectation, expect

__all__ = ["LEVELS", "Expectation", "expect", "plan"]
