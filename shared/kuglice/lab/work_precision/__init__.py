"""Work-precision diagrams, after the SciML benchmarks: what accuracy costs, per method and length of tick."""

from kuglice.lab.work_precision.draw import draw
from kuglice.lab.work_precision.measure import jobs
from kuglice.lab.work_precision.scenes import TABLE, Subject, subject

__all__ = ["TABLE", "Subject", "draw", "jobs", "subject"]
