"""Four panels: what one sees and what it takes, against round trip and against the rate of updates."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from matplotlib.axes import Axes

from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import PALE, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.network_cost.measure import PLAYED, VIEWED
from kuglice.lab.rows import Rows, where

__all__ = ["draw"]

COLOUR = dict(zip((*PLAYED, *VIEWED), ("#d55e00", "#0072b2", "#009e73", "#cc79a7"), strict=True))
SAID = {"arena": "four act", "arena, one acts": "one acts", "gas:n=1000": "gas", "rain:n=1000": "rain"}
SMALLEST_RADII = 1e-4
TARGET_RADII = 0.05
"""Below it lies the mean where nobody else acts: the bar of this house."""
KBIT = 0.008


class Curve(NamedTuple):
    """A column of rows, what it is called, and how it is drawn."""

    column: str
    name: str
    style: str
    scale: float = 1.0
    floor: float = 0.0


def draw(rows: Rows) -> Figure:
    """One colour per scene."""
    games, views = where(rows, varied="round_trip"), where(rows, varied="region_rate")
    link = next((str(row["link"]) for row in games), "link")
    figure, panels = sheet(
        "What distance costs",
        f"Above: players in an arena over a {link}, 60 ticks per second, datagrams beside tcp, 2 % of the packets"
        " lost each way, 20 % jitter; how far balls are drawn from where they are (none: 0.0001). Below: views of"
        " about 1,000 balls; how far off a ball was predicted when it is told again.",
        rows=2,
        columns=2,
        height=12.2,
    )
    seen = [
        Curve(f"visible_{what}_radii", what, style, floor=SMALLEST_RADII)
        for what, style in (("mean", "-"), ("worst", "--"))
    ]
    sent = [Curve(f"payload_{way}", way, style, scale=KBIT) for way, style in (("down", "-"), ("up", "--"))]
    predicted = [
        Curve(f"prediction_error_{what}_radii", what, style) for what, style in (("mean", "-"), ("p99", "--"))
    ]
    told = [Curve("view_bytes_per_second", "", "-", scale=KBIT)]
    panels[0].axhline(TARGET_RADII, color=PALE, linewidth=1.0, linestyle=":")
    for panel, title, quantity, curves in (
        (panels[0], "A player sees", "Visible correction, in radii", seen),
        (panels[1], "A player takes", "kbit per second", sent),
    ):
        _panel(panel, title, quantity, _drawn(panel, games, "round_trip_ms", PLAYED, curves))
        panel.set_xlabel("Round trip, ms")
    for panel, title, quantity, curves in (
        (panels[2], "A view sees", "Error of prediction, in radii", predicted),
        (panels[3], "A view takes", "kbit per second", told),
    ):
        panel.set_xscale("log")
        _panel(panel, title, quantity, _drawn(panel, views, "region_rate", VIEWED, curves))
        panel.set_xlabel("Updates per second")
    return figure


def _drawn(axes: Axes, rows: Rows, along: str, scenes: Iterable[str], curves: Iterable[Curve]) -> list[Label]:
    """Draw a curve per scene and column; their names, at the ends."""
    labels = []
    for scene in scenes:
        for curve in curves:
            points = sorted(
                (float(row[along]), max(float(value) * curve.scale, curve.floor))
                for row in where(rows, scene=scene)
                if (value := row.get(curve.column, "")) != ""
            )
            if not points:
                continue
            x, y = zip(*points, strict=True)
            axes.plot(
                x, y, curve.style, marker="o", color=COLOUR[scene], markeredgecolor="white", markersize=6
            )
            name = ", ".join(part for part in (SAID[scene], curve.name) if part)
            labels.append(Label(name, x[-1], y[-1], COLOUR[scene]))
    # Ticks where something was measured.
    ticks = sorted({float(row[along]) for row in rows})
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.xaxis.minorticks_off()
    return labels


def _panel(axes: Axes, title: str, quantity: str, labels: list[Label]) -> None:
    axes.set_title(title)
    axes.set_ylabel(quantity)
    if "radii" in quantity:
        axes.set_yscale("log")
    else:
        axes.set_ylim(bottom=0.0)
    low, high = axes.get_xlim()
    logarithmic = axes.get_xscale() == "log"
    axes.set_xlim(low, high * (high / low) ** 0.35 if logarithmic else high + 0.35 * (high - low))
    write_labels(axes, labels)
