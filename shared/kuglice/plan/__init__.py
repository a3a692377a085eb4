"""The planner: the cheapest model that meets what a scene demands, with its reasons in words."""

from kuglice.plan.demand import LEVELS
from kuglice.plan.expectation import Expectation, expect
from kuglice.plan.planner import plan

__all__ = ["LEVELS", "Expectation", "expect", "plan"]
