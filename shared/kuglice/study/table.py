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
    """`frames`: those of the study. Delays in milliseconds; None where there is nothing to count.

    `predicted_equal`: share of frames whose predicted state had the very bits that the server's had in the end.
    """
    rollbacks = [event for event in study.events if isinstance(event, Rollback)]
    answered = [event for event in study.events if isinstance(event, Answered)]
    delays = own_screen_delays(study)
    own = [frame.own_error for frame in frames if frame.own_error is not None]
    return {
        "name": study.joined.name,
        "seconds": study.events[-1].at - study.began,
        "joined": sum(isinstance(event, Joined) for event in study.events),
        "frames": sum(isinstance(event, DrawnFrame) for event in study.events),
        "frames_compared": len(frames),
        "predicted_equal": _mean(frame.predicted_equal for frame in frames),
        "ticks_ahead": _mean(frame.ahead for frame in frames),
        "mean_error_radii": _mean(frame.mean_error for frame in frames),
        "worst_error_radii": max((frame.worst_error for frame in frames), default=None),
        "own_mean_error_radii": _mean(own),
        "own_worst_error_radii": max(own, default=None),
        "rollbacks": len(rollbacks),
        "mean_rollback_ticks": _mean(one.end - one.first for one in rollbacks),
        "inputs_answered": len(answered),
        "inputs_late": sum(one.early is not None and one.early < 0 for one in answered),
        "own_screen_delay_ms": _milliseconds(delays),
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
                "ticks_ahead": round(statistics.fmean(frame.ahead for frame in here), 1),
                "predicted_equal": round(statistics.fmean(frame.predicted_equal for frame in here), 3),
                "mean_error_radii": round(statistics.fmean(frame.mean_error for frame in here), 4),
                "worst_error_radii": round(max(frame.worst_error for frame in here), 4),
                "own_mean_error_radii": round(statistics.fmean(own), 4) if own else None,
                "rollbacks": sum(isinstance(event, Rollback) for event in events),
                "inputs_late": sum(
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
