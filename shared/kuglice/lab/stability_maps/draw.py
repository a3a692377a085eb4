"""Four maps: springs, tunnels, and crowds without and with weight."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import CONTACTS, INK, INTEGRATOR, PALE, PEER, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.rows import Rows, where
from kuglice.lab.stability_maps.crowd import COUNT
from kuglice.lab.stability_maps.oscillator import BOUNDARY, STEPS

__all__ = ["draw"]

OFFSET = {"euler": (10, -4), "symplectic_euler": (0, 10), "verlet": (-6, -22), "rk4": (0, 10)}
"""Of names from their curves, in points."""
HIGHEST = 1e12
"""Energies beyond are cut: they say no more than that it exploded."""


def draw(rows: Rows) -> Figure:
    """Points are measured, thin black lines are theory."""
    figure, panels = sheet(
        "Where methods fail",
        "Points: measured. Thin black lines: theory. Top left, a ball on a spring; top right, pairs that meet"
        f" head-on; below, {COUNT} elastic balls in a box, without and with gravity.",
        rows=2,
        columns=2,
        height=11.6,
    )
    _oscillator(panels[0], where(rows, map="oscillator"))
    _tunnelling(panels[1], where(rows, map="tunnelling"))
    _crowd(
        panels[2],
        where(rows, map="drift"),
        "Energy in a crowd",
        "Largest relative drift of energy",
        logarithmic=True,
    )
    _crowd(
        panels[3],
        where(rows, map="sinking"),
        "Room in a crowd with weight",
        "Deepest overlap, in radii (2: two centres meet)",
        logarithmic=False,
    )
    return figure


def _curves(rows: Rows) -> dict[str, tuple[list[float], list[float], list[float]]]:
    found = {}
    for method in dict.fromkeys(str(row["method"]) for row in rows):
        points = sorted(
            (float(row["x"]), float(row["value"]), float(row.get("theory", np.nan)))
            for row in where(rows, method=method)
        )
        x, value, theory = (list(part) for part in zip(*points, strict=True))
        found[method] = (x, value, theory)
    return found


def _oscillator(axes: Axes, rows: Rows) -> None:
    axes.set_title("Integrators on a spring")
    axes.set_yscale("log")
    for boundary, text in ((2.0, "2"), (BOUNDARY["rk4"], "2\u221a2")):
        axes.axvline(boundary, color=PALE, linestyle=":", linewidth=1.2)
        axes.annotate(text, (boundary, 0.30), xycoords=("data", "axes fraction"), xytext=(4, 0),
                      textcoords="offset points", fontsize=11, color=INK)  # fmt: skip
    places = {"euler": 0.35, "symplectic_euler": 1.0, "verlet": 1.75, "rk4": 2.35}
    for method, (x, value, theory) in _curves(rows).items():
        clipped = np.clip(value, 1.0 / HIGHEST, HIGHEST)
        axes.plot(x, np.clip(theory, 1.0 / HIGHEST, HIGHEST), color=INK, linewidth=0.9, zorder=2)
        marker = "s" if method == "symplectic_euler" else "o"
        axes.plot(
            x, clipped, marker, color=INTEGRATOR[method], markersize=6 if method != "verlet" else 4, zorder=3
        )
        near = int(np.argmin(np.abs(np.array(x) - places[method])))
        axes.annotate(
            method.replace("_", " "), (x[near], clipped[near]),
            xytext=OFFSET[method],
            textcoords="offset points", color=INTEGRATOR[method], fontsize=11.5, fontweight="bold",
            ha="left" if method == "euler" else "center",
        )  # fmt: skip
    axes.set_xlabel("\u03c9 \u00b7 dt (radians of the oscillation per step)")
    axes.set_ylabel(f"Energy after {STEPS} steps, relative to the start")


def _tunnelling(axes: Axes, rows: Rows) -> None:
    axes.set_title("Head-on pairs that pass through each other")
    axes.set_xscale("log")
    labels = []
    for method, (x, value, theory) in _curves(rows).items():
        colour = CONTACTS[method]
        # Different sizes, because two treatments lie on one curve.
        size = {"overlap": 9, "backtrack": 5}.get(method, 6)
        axes.plot(x, value, "o", color=colour, markersize=size, zorder=4 if method == "backtrack" else 3)
        if method == "overlap":
            axes.plot(x, theory, color=INK, linewidth=0.9, zorder=2)
        labels.append(Label(method, x[-1], value[-1], colour))
    axes.axvline(2.0, color=PALE, linestyle=":", linewidth=1.2)
    axes.annotate("one diameter", (2.0, 0.5), xycoords=("data", "axes fraction"), xytext=(-5, 0),
                  textcoords="offset points", fontsize=11, color=INK, ha="right")  # fmt: skip
    low, high = axes.get_xlim()
    axes.set_xlim(low, high * (high / low) ** 0.2)
    axes.set_xlabel("Relative move in a tick, in radii")
    axes.set_ylabel("Share that tunnels")
    write_labels(axes, labels, size=11.5)


def _crowd(axes: Axes, rows: Rows, title: str, label: str, *, logarithmic: bool) -> None:
    axes.set_title(title)
    if logarithmic:
        axes.set_yscale("log")
    labels = []
    for method, (x, value, _) in _curves(rows).items():
        colour = CONTACTS.get(method, PEER)
        line = "o-" if method in CONTACTS else "D--"
        axes.plot(x, value, line, color=colour, markeredgecolor="white", clip_on=False)
        labels.append(Label(method, x[-1], value[-1], colour))
    if not logarithmic:
        axes.set_ylim(0.0, 2.1)
    axes.set_xlim(0.0, 1.0)
    axes.set_xticks([0.0, 0.2, 0.4, 0.6, 0.8])
    axes.set_xlabel("Packing fraction")
    axes.set_ylabel(label)
    write_labels(axes, labels, size=11.5)
