"""Three panels: whether results depend on frames, and how motion looks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes

from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import INK, PALE, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.rows import Rows, where

__all__ = ["draw"]

COLOUR = {
    "variable": "#d55e00",
    "variable, event contacts": "#cc79a7",
    "fixed": "#009e73",
    "interpolated": "#0072b2",
}
FLOOR = 1e-16


def draw(rows: Rows) -> Figure:
    """One colour per loop."""
    figure, panels = sheet(
        "What a loop does",
        "Left: a gas of 100 balls, run at 20, 60 and 144 frames per second and with jittered frames; fixed steps"
        " give the same bits whatever the frames. Right: a ball in free flight as it is seen, 60 ticks per second.",
        rows=1,
        columns=2,
        height=7.2,
    )
    _spread(panels[0], where(rows, kind="spread"))
    _steps(panels[1], where(rows, kind="step"), where(rows, kind="jitter"))
    return figure


def _curves(rows: Rows) -> Iterator[tuple[str, str, Sequence[float], Sequence[float]]]:
    """Loop, colour, x and value of each loop that there are rows of."""
    for loop, colour in COLOUR.items():
        points = [(float(row["x"]), float(row["value"])) for row in where(rows, loop=loop)]
        if points:
            x, value = zip(*points, strict=True)
            yield loop, colour, x, value


def _spread(axes: Axes, rows: Rows) -> None:
    axes.set_title("Do results depend on the frame rate?")
    axes.set_yscale("log")
    labels = []
    for loop, colour, x, value in _curves(rows):
        drawn = np.maximum(value, FLOOR)
        axes.plot(
            x, drawn, "o-", color=colour, markeredgecolor="white", markersize=5 if loop == "fixed" else 8
        )
        exact = ": exactly 0" if max(value) == 0.0 else ""
        labels.append(Label(loop + exact, x[-1], float(drawn[-1]), colour))
    low, high = axes.get_xlim()
    axes.set_xlim(low, high + 0.6 * (high - low))
    axes.set_xticks([0, 1, 2, 3])
    axes.set_xlabel("Simulated seconds")
    axes.set_ylabel("Distance between runs at different\nframe rates, in radii (RMS)")
    write_labels(axes, labels, size=11.5)


def _steps(axes: Axes, rows: Rows, jitter: Rows) -> None:
    axes.set_title("How does it look at 144 frames per second?")
    labels = []
    for loop, colour, x, value in _curves(rows):
        # A dot in a ring, where two loops are both right.
        size = 5 if loop == "interpolated" else 9
        axes.plot(x, value, "o-", color=colour, linewidth=1.2, markersize=size, markeredgecolor="white",
                  zorder=4 if loop == "interpolated" else 3)  # fmt: skip
        listed = [f"{row['pattern']} {float(row['value']):.0%}" for row in where(jitter, loop=loop)]
        text = f"{loop}\n" + "\n".join(f"  {each}" for each in listed)
        labels.append(Label(text, x[-1], value[-1], colour))
    axes.set_ylim(-0.15, 2.9)
    low, high = axes.get_xlim()
    axes.set_xlim(low, high + 0.42 * (high - low))
    axes.set_xticks([0, 10, 20, 30])
    axes.axhline(1.0, color=PALE, linewidth=0.8, linestyle=":")
    for label, place in zip(labels, (0.93, 0.63, 0.33), strict=False):
        axes.annotate(
            label.text, (0.76, place), xycoords="axes fraction", va="top", color=label.colour, fontsize=11
        )
    axes.annotate("jitter (RMS):", (0.76, 1.0), xycoords="axes fraction", va="top", fontsize=10,
                  color=INK)  # fmt: skip
    axes.set_xlabel("Frame")
    axes.set_ylabel("Step on the screen, relative to the right one")
