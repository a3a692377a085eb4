"""How real time becomes ticks: what each loop does to results, and to what one sees."""

from kuglice.lab.loops.draw import draw
from kuglice.lab.loops.measure import jobs

__all__ = ["draw", "jobs"]
