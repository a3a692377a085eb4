"""All charts by name: jobs that measure, and a function that draws what they measured."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from kuglice.lab import calibration, cost_growth, loops, network_cost, stability_maps, work_precision
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.rows import Rows
from kuglice.lab.work_precision.scenes import Subject

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Chart", "charts", "scene_chart"]


@dataclass(frozen=True)
class Chart:
    """`jobs(effort, left_out)` appends to left_out what cannot be measured, with the reason."""

    name: str
    jobs: Callable[[Effort, list[str]], list[Job]]
    draw: Callable[[Rows], Figure]


def charts() -> list[Chart]:
    """In the order in which they are made."""
    diagrams = [scene_chart(name, subject) for name, subject in work_precision.TABLE.items()]
    return [
        *diagrams,
        Chart("cost_growth", cost_growth.jobs, cost_growth.draw),
        Chart("stability_maps", stability_maps.jobs, stability_maps.draw),
        Chart("loops", loops.jobs, loops.draw),
        Chart("network_cost", network_cost.jobs, network_cost.draw),
        Chart("planner", calibration.jobs, calibration.draw),
    ]


def scene_chart(name: str, subject: Subject) -> Chart:
    """The work-precision diagram of one scene."""
    return Chart(
        f"work_precision_{name}",
        partial(work_precision.jobs, name, subject),
        partial(work_precision.draw, subject.title),
    )
