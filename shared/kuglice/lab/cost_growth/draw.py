"""Four panels: number of balls, levels of the tree, spread of radii, packing."""

from __future__ import annotations

from matplotlib.axes import Axes

from kuglice.lab.cost_growth.fit import crossing, exponent
from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import BROADPHASE, INK, PALE, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.rows import Rows, where

__all__ = ["draw"]

PANELS = {
    "count": ("The more balls", "Number of balls", True),
    "levels": ("The higher the quadtree", "Levels of the classical quadtree", False),
    "ratio": ("The more unequal the radii", "Largest radius : smallest radius", True),
    "packing": ("The denser the balls", "Packing fraction", False),
}
FIT_FROM = 1_000
"""Below, what a tick costs whatever its balls is still seen."""


def draw(rows: Rows) -> Figure:
    """One curve per broadphase."""
    figure, panels = sheet(
        "How cost grows",
        "Cost of a ball-step: gas at packing 0.30, contacts overlap, one thread, one thing varied at a time."
        " The exponent k tells how the cost of a ball grows with the number of balls: 1 for every pair, 0 for a"
        " method that does not care.",
        rows=2,
        columns=2,
        height=11.6,
    )
    for panel, (varied, (title, label, logarithmic)) in zip(panels, PANELS.items(), strict=True):
        _panel(panel, where(rows, varied=varied), title, label, logarithmic)
    _crossing(panels[0], where(rows, varied="count"))
    return figure


def _panel(axes: Axes, rows: Rows, title: str, label: str, logarithmic: bool) -> None:
    axes.set_title(title)
    axes.set_xlabel(label)
    axes.set_ylabel("ns per ball-step")
    axes.set_yscale("log")
    if logarithmic:
        axes.set_xscale("log")
    labels = []
    for name, colour in BROADPHASE.items():
        curve = sorted((float(row["value"]), float(row["cost"])) for row in where(rows, broadphase=name))
        if not curve:
            continue
        x, y = zip(*curve, strict=True)
        axes.plot(x, y, "o-", color=colour, markeredgecolor="white", markeredgewidth=0.7)
        text = name.replace("_", " ")
        far = [point for point in curve if point[0] >= FIT_FROM]
        if label == PANELS["count"][1] and len(far) > 1:
            text += f", k = {exponent(*zip(*far, strict=True)):.2f}"
        labels.append(Label(text, x[-1], y[-1], colour))
    low, high = axes.get_xlim()
    ticks = [float(tick) for tick in axes.get_xticks() if low <= tick <= high]
    axes.set_xticks(ticks)
    axes.set_xlim(low, high * (high / low) ** 0.42 if logarithmic else high + 0.42 * (high - low))
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom / 1.5, top * 1.5)
    ends = sorted({label.x for label in labels})
    # The curve that ends first has its neighbours on the right.
    early = [label for label in labels if label.x == ends[0] and len(ends) > 1]
    write_labels(axes, early, side="left")
    write_labels(axes, [label for label in labels if label not in early])


def _crossing(axes: Axes, rows: Rows) -> None:
    curves = {
        name: {float(row["value"]): float(row["cost"]) for row in where(rows, broadphase=name)}
        for name in ("brute", "loose_quadtree")
    }
    shared = sorted(set(curves["brute"]) & set(curves["loose_quadtree"]))
    costs = [[curves[name][value] for value in shared] for name in curves]
    place = crossing(shared, costs[0], costs[1])
    if place is None:
        return
    axes.axvline(place, color=PALE, linestyle=":", linewidth=1.2)
    axes.annotate(
        f"brute force is best\nup to {place:.0f} balls", (place, 0.97), xycoords=("data", "axes fraction"),
        xytext=(8, 0), textcoords="offset points", ha="left", va="top", fontsize=11, color=INK,
    )  # fmt: skip
