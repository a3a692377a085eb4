"""Names written at the ends of curves, moved apart where they would cover each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes

__all__ = ["Label", "write_labels"]

LINE = 15.0
"""Points from one label to the next."""


class Label(NamedTuple):
    """A name for the curve that ends at (x, y), in data coordinates."""

    text: str
    x: float
    y: float
    colour: str


def write_labels(axes: Axes, labels: Sequence[Label], *, side: str = "right", size: float = 10.5) -> None:
    """To the right (or left) of each end; those that would overlap are moved up or down, order kept."""
    figure = axes.get_figure()
    if not labels or figure is None:
        return
    figure.canvas.draw()
    to_points = 72.0 / figure.dpi
    places = sorted(
        (float(axes.transData.transform((label.x, label.y))[1]) * to_points, index)
        for index, label in enumerate(labels)
    )
    heights = _apart([height for height, _ in places])
    sign = 1 if side == "right" else -1
    for (own, index), height in zip(places, heights, strict=True):
        label = labels[index]
        moved = abs(height - own) > 0.5 * LINE
        axes.annotate(
            label.text,
            (label.x, label.y),
            xytext=(sign * (22 if moved else 9), height - own),
            textcoords="offset points",
            color=label.colour,
            fontsize=size,
            ha="left" if side == "right" else "right",
            va="center",
            arrowprops={"arrowstyle": "-", "color": label.colour, "lw": 0.6, "shrinkB": 3} if moved else None,
            annotation_clip=False,
            zorder=5,
        )


def _apart(heights: list[float]) -> list[float]:
    """The nearest heights (in order) that are LINE apart, by pooling neighbours that are too close."""
    groups: list[list[float]] = []
    for height in heights:
        groups.append([height])
        while len(groups) > 1 and _bottom(groups[-1]) < _top(groups[-2]) + LINE:
            last = groups.pop()
            groups[-1] += last
    return [_bottom(group) + LINE * place for group in groups for place in range(len(group))]


def _bottom(group: list[float]) -> float:
    return sum(group) / len(group) - LINE * (len(group) - 1) / 2.0


def _top(group: list[float]) -> float:
    return _bottom(group) + LINE * (len(group) - 1)
