"""The Pareto front: points that no other point beats in both error and cost."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ["front"]


def front(points: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    """(error, cost), by rising error and falling cost."""
    kept: list[tuple[float, float]] = []
    for error, cost in sorted(points):
        if not kept or cost < kept[-1][1]:
            kept.append((error, cost))
    return kept
