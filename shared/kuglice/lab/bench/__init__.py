"""`kuglice bench`: what a ball-step costs, with peers on the same initial state in the same run."""

from kuglice.lab.bench.case import Case
from kuglice.lab.bench.table import cases
from kuglice.lab.bench.targets import judged

__all__ = ["Case", "cases", "judged"]
