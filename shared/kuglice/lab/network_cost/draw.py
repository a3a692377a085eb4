"""Two panels: what one sees, and what it takes."""

from __future__ import annotations

from matplotlib.axes import Axes

from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import PALE, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.network_cost.measure import PLAYED
from kuglice.lab.rows import Rows, where

__all__ = ["draw"]

COLOUR = {"arena": "#d55e00", "arena, one acts": "#0072b2"}
SAID = {"arena": "four act", "arena, one acts": "one acts"}
SMALLEST_RADII = 1e-4
TARGET_RADII = 0.05
"""Below it lies the mean where nobody else acts: the bar of this house."""


def draw(rows: Rows) -> Figure:
    """One colour per game."""
    link = next((str(row["link"]) for row in rows), "link")
    figure, panels = sheet(
        "What distance costs",
        f"An arena of 20 balls at 60 ticks per second over a {link}, datagrams beside tcp, 2 % of the packets lost each"
        " way, 20 % jitter. Left: how far balls are drawn from where they are, while corrections glide; solid the mean"
        " over balls and frames, dashed the worst; none at all is drawn as 0.0001. Right: payload per client.",
        rows=1,
        columns=2,
        height=7.4,
    )
    varied = where(rows, varied="round_trip")
    _errors(panels[0], varied)
    _bytes(panels[1], varied)
    for panel in panels:
        panel.set_xlabel("Round trip, ms")
        low, high = panel.get_xlim()
        panel.set_xlim(low, high + 0.35 * (high - low))
        panel.set_xticks(sorted({float(row["round_trip_ms"]) for row in varied}))
    return figure


def _errors(axes: Axes, rows: Rows) -> None:
    axes.set_title("What is seen")
    axes.set_yscale("log")
    axes.set_ylabel("Visible correction, in radii")
    axes.axhline(TARGET_RADII, color=PALE, linewidth=1.0, linestyle=":")
    labels = []
    for name in PLAYED:
        for what, style in (("mean", "-"), ("worst", "--")):
            labels += _curve(
                axes,
                rows,
                name,
                f"visible_{what}_radii",
                f"{SAID[name]}, {what}",
                style=style,
                floor=SMALLEST_RADII,
            )
    write_labels(axes, labels)


def _bytes(axes: Axes, rows: Rows) -> None:
    axes.set_title("What it takes")
    axes.set_ylabel("kbit per second and client")
    labels = []
    for name in PLAYED:
        for way, style in (("down", "-"), ("up", "--")):
            labels += _curve(
                axes, rows, name, f"payload_{way}", f"{SAID[name]}, {way}", style=style, scale=0.008
            )
    axes.set_ylim(bottom=0.0)
    write_labels(axes, labels)


def _curve(
    axes: Axes,
    rows: Rows,
    name: str,
    column: str,
    text: str,
    *,
    style: str,
    scale: float = 1.0,
    floor: float = 0.0,
) -> list[Label]:
    points = sorted(
        (float(row["round_trip_ms"]), float(value) * scale)
        for row in where(rows, scene=name)
        if (value := row.get(column, "")) != ""
    )
    if not points:
        return []
    x, y = zip(*points, strict=True)
    y = tuple(max(value, floor) for value in y)
    axes.plot(x, y, style, marker="o", color=COLOUR[name], markeredgecolor="white", markersize=6)
    return [Label(text, x[-1], y[-1], COLOUR[name])]
