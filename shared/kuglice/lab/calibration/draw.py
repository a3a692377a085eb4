"""The planner's table, drawn: what it believes about errors and costs."""

from __future__ import annotations

from matplotlib.axes import Axes

from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import BROADPHASE, CONTACTS, INTEGRATOR, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.rows import Rows, where

__all__ = ["draw"]

FLOOR = 1e-16
DASHES = {0.05: ":", 0.3: "-", 0.6: "--"}


def draw(rows: Rows) -> Figure:
    """Errors of contacts, errors of integrators, costs of ball-steps."""
    figure, panels = sheet(
        "What the planner knows",
        "Errors and costs from which plan(scene) picks the cheapest model that will do. Left: packing 0.05 dotted,"
        " 0.30 solid, 0.60 dashed. Middle: a spring (solid), an orbit (dashed), drag (dotted). Right: calm gas"
        " (dotted) and busy gas (solid); triangles: brute force.",
        rows=1,
        columns=3,
        height=7.4,
    )
    _contacts(panels[0], where(rows, kind="contact error"))
    _forces(panels[1], where(rows, kind="force error"))
    _costs(panels[2], where(rows, kind="cost"))
    return figure


def _contacts(axes: Axes, rows: Rows) -> None:
    axes.set_title("Contacts")
    labels = []
    for contacts, colour in CONTACTS.items():
        for packing, line in DASHES.items():
            found = where(rows, contacts=contacts, packing=packing)
            if found:
                x, y = _curve(axes, found, line, colour)
                if packing == 0.3:
                    labels.append(Label(contacts, x, y, colour))
    _finish(axes, labels, "Move in a tick, in radii", "Position error after one collision per ball, in radii")


def _forces(axes: Axes, rows: Rows) -> None:
    axes.set_title("Integrators")
    labels = []
    for integrator, colour in INTEGRATOR.items():
        for kind, line in (("spring", "-"), ("orbit", "--"), ("velocity", ":")):
            found = where(rows, integrator=integrator, force=kind)
            if found:
                x, y = _curve(axes, found, line, colour)
                if kind == "spring":
                    labels.append(Label(integrator.replace("_", " "), x, y, colour))
    _finish(axes, labels, "\u03c9 \u00b7 dt", "Position error per radian, in amplitudes")


def _costs(axes: Axes, rows: Rows) -> None:
    axes.set_title("Costs")
    labels = []
    for contacts, colour in CONTACTS.items():
        found = where(rows, contacts=contacts, broadphase="loose_quadtree")
        counts = sorted({int(row["balls"]) for row in found})
        for pick, line in ((min, ":"), (max, "-")):
            curve = [pick(where(found, balls=count), key=lambda row: float(row["x"])) for count in counts]
            if curve:
                y = [float(row["value"]) for row in curve]
                axes.plot(counts, y, line, color=colour, marker="o", markersize=4)
                if line == "-":
                    labels.append(Label(contacts, counts[-1], y[-1], colour))
    brute = where(rows, contacts="overlap", broadphase="brute")
    axes.plot(
        [float(row["balls"]) for row in brute], [float(row["value"]) for row in brute], "^", markersize=5,
        color=BROADPHASE["brute"], markerfacecolor="none",
    )  # fmt: skip
    _finish(axes, labels, "Number of balls", "ns per ball-step")


def _curve(axes: Axes, rows: Rows, line: str, colour: str) -> tuple[float, float]:
    x, y = zip(*sorted((float(row["x"]), max(float(row["value"]), FLOOR)) for row in rows), strict=True)
    axes.plot(x, y, line, color=colour, marker="o", markersize=4)
    return x[-1], y[-1]


def _finish(axes: Axes, labels: list[Label], across: str, along: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    low, high = axes.get_xlim()
    axes.set_xlim(low, high * (high / low) ** 0.45)
    axes.set_xlabel(across)
    axes.set_ylabel(along)
    write_labels(axes, labels)
