"""One look for all charts: legible on a projector, and for colour-blind eyes (palette: Okabe & Ito)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from kuglice.extras import extra

with extra("lab"):
    import matplotlib as mpl
    from matplotlib.figure import Figure

__all__ = [
    "BROADPHASE",
    "CONTACTS",
    "FRONT",
    "INK",
    "INTEGRATOR",
    "MARKER",
    "PALE",
    "PEER",
    "Figure",
    "look",
]

INK = "#222222"
PALE = "#8a8a8a"
FRONT = "#f0e6b4"
CONTACTS = {"overlap": "#d55e00", "backtrack": "#009e73", "event": "#0072b2"}
INTEGRATOR = {"euler": "#d55e00", "symplectic_euler": "#cc79a7", "verlet": "#0072b2", "rk4": "#009e73"}
BROADPHASE = {"brute": "#d55e00", "quadtree": "#cc79a7", "loose_quadtree": "#0072b2"}
PEER = "#555555"
MARKER = {"euler": "v", "symplectic_euler": "s", "verlet": "o", "rk4": "^"}

SETTINGS: dict[Any, Any] = {
    "figure.facecolor": "white",
    "font.family": "DejaVu Sans",
    "font.size": 12,
    "axes.titlesize": 13,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 12,
    "axes.edgecolor": PALE,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e6e6e6",
    "grid.linewidth": 0.8,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "lines.linewidth": 2.0,
    "lines.markersize": 7,
    "legend.frameon": False,
    "svg.fonttype": "none",
    # The same ids in each SVG, so that equal charts are equal files.
    "svg.hashsalt": "kuglice",
}


@contextmanager
def look() -> Iterator[None]:
    """Inside, figures look like the lab's. Draws to files only: no window system is asked for."""
    with mpl.rc_context(SETTINGS):
        yield
