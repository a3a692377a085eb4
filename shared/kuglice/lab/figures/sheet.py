"""A sheet: title, subtitle, panels, footer; saved as PNG and SVG."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.layout_engine import ConstrainedLayoutEngine

from kuglice.lab.figures.look import INK, PALE, Figure

__all__ = ["save", "sheet"]

WIDTH = 14.0
DPI = 110


def sheet(
    title: str, subtitle: str, *, rows: int, columns: int, height: float, key: bool = False
) -> tuple[Figure, list[Axes]]:
    """An empty sheet and its panels, row by row; `key` leaves a line for what colours and markers mean."""
    above = 1.4 if key else 1.1
    room = (0.005, 0.75 / height, 0.99, 1.0 - (0.75 + above) / height)
    layout = ConstrainedLayoutEngine(rect=room, h_pad=0.12, w_pad=0.12, hspace=0.03, wspace=0.03)
    figure = Figure(figsize=(WIDTH, height), layout=layout)
    figure.text(0.012, 1.0 - 0.16 / height, title, fontsize=19, fontweight="bold", va="top", color=INK)
    text = "\n".join(textwrap.wrap(subtitle, 150))
    figure.text(0.012, 1.0 - 0.56 / height, text, fontsize=12, va="top", color="#444444", linespacing=1.35)
    axes = figure.subplots(rows, columns, squeeze=False)
    return figure, [panel for line in axes for panel in line]


def save(figure: Figure, path: Path, footer: Sequence[str]) -> list[Path]:
    """`path` without ending: .png and .svg are written."""
    height = figure.get_size_inches()[1]
    lines = [part for line in footer for part in textwrap.wrap(line, 215)]
    figure.text(
        0.012, 0.08 / height, "\n".join(lines), fontsize=8.5, va="bottom", color=PALE, linespacing=1.35
    )
    as_png, as_svg = path.with_suffix(".png"), path.with_suffix(".svg")
    figure.savefig(as_png, dpi=DPI)
    figure.savefig(as_svg, metadata={"Date": None})
    return [as_png, as_svg]
