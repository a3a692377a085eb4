"""A study in figures: of the whole, and second by second."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Sequence
from typing import Any

from kuglice.study.delays import own_screen_delays
from kuglice.study.format import Answered, DrawnFrame, Joined, Rollback
from kuglice.study.study import SeenFrame, Study

__all__ = ["by_second", "summary"]


def summary(study: Study, frames: Sequence[SeenFrame]) -> dict[str, Any]:
    """`frames`: those of the study. Errors in radii, delays in milliseconds; None where there is nothing to count."""
    rollbacks = [event for event in study.events if isinstance(event, Rollback)]
    answered = [event for event in study.events if isinstance(event, Answered)]
    delays = own_screen_delays(study)
    own = [frame.own_error for frame in frames if frame.own_error is not None]
    return {
        "name": study.joined.name,
        "seconds": study.events[-1].at - study.began,
        "joined": sum(isinstance(event, Joined) for event in study.events),
        "frames": sum(isinstance(event, DrawnFrame) for event in study.events),
        "frames compared": len(frames),
        "predicted right": _mean(frame.right for frame in frames),
        "ticks ahead": _mean(frame.ahead for frame in frames),
        "mean error radii": _mean(frame.mean_error for frame in frames),
        "worst error radii": max((frame.worst_error for frame in frames), default=None),
        "own mean error radii": _mean(own),
        "own worst error radii": max(own, default=None),
        "rollbacks": len(rollbacks),
        "mean rollback ticks": _mean(one.end - one.first for one in rollbacks),
        "inputs answered": len(answered),
        "inputs late": sum(one.early is not None and one.early < 0 for one in answered),
        "own screen delay ms": _milliseconds(delays),
    }


def by_second(study: Study, frames: Sequence[SeenFrame]) -> list[dict[str, Any]]:
    """One row per second of the study in which a frame can be compared."""
    rows = []
    for second in sorted({int(frame.at) for frame in frames}):
        here = [frame for frame in frames if int(frame.at) == second]
        events = [event for event in study.events if int(event.at - study.began) == second]
        own = [frame.own_error for frame in here if frame.own_error is not None]
        rows.append(
            {
                "second": second,
                "frames": sum(isinstance(event, DrawnFrame) for event in events),
                "ticks ahead": round(statistics.fmean(frame.ahead for frame in here), 1),
                "right %": round(100 * statistics.fmean(frame.right for frame in here), 1),
                "mean error": round(statistics.fmean(frame.mean_error for frame in here), 4),
                "worst error": round(max(frame.worst_error for frame in here), 4),
                "own error": round(statistics.fmean(own), 4) if own else "",
                "rollbacks": sum(isinstance(event, Rollback) for event in events),
                "late inputs": sum(
                    isinstance(event, Answered) and event.early is not None and event.early < 0
                    for event in events
                ),
            }
        )
    return rows


def _mean(values: Iterable[float]) -> float | None:
    listed = list(values)
    return statistics.fmean(listed) if listed else None


def _milliseconds(delays: Sequence[float]) -> float | None:
    mean = _mean(delays)
    return None if mean is None else 1000 * mean
