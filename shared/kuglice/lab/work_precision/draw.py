"""The four panels of a work-precision diagram."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from kuglice.lab.figures.labels import Label, write_labels
from kuglice.lab.figures.look import CONTACTS, FRONT, INK, MARKER, PALE, PEER, Figure
from kuglice.lab.figures.sheet import sheet
from kuglice.lab.rows import Row, Rows
from kuglice.lab.work_precision.front import front

__all__ = ["draw"]

PANELS = {
    "position_error": "Position error after one collision per ball or 1 s, in radii (RMS)",
    "energy_drift": "Relative drift of energy in the long run (largest)",
    "deepest_overlap": "Deepest overlap in the long run, in radii",
    "missed": "Share of collisions missed",
}
REASONS = {
    "position_error": "No method could follow this scene.",
    "energy_drift": "No panel for energy: it is not conserved here.",
    "deepest_overlap": "No panel for overlaps.",
    "missed": "No panel for collisions: there are none.",
}
FEW = 6
"""Curves up to here are labelled one by one."""
PEER_MARKERS = "DPX*"


def draw(title: str, rows: Rows) -> Figure:
    """One curve per method, one point per length of tick."""
    shown = {name: label for name, label in PANELS.items() if any(name in row for row in rows)}
    if "missed" not in shown:
        # Nothing collides, so what overlaps is a planet that its integrator has lost.
        shown.pop("deepest_overlap", None)
    lines = (len(shown) + 1) // 2
    rates = sorted({int(row["tick_rate"]) for row in rows})
    figure, panels = sheet(
        f"Work and precision: {title}",
        f"Each point is one length of tick, from 1/{rates[0]} s (low) to 1/{rates[-1]} s (high). Farther left"
        " is more accurate, farther down is cheaper. Yellow: the best that any method reaches.",
        rows=lines,
        columns=2,
        key=not _few(rows),
        height=2.5 + 4.6 * lines,
    )
    for panel, (name, label) in zip(panels, shown.items(), strict=False):
        _panel(panel, name, label, rows)
    for panel in panels[len(shown) :]:
        panel.axis("off")
        missing = [REASONS[name] for name in PANELS if name not in shown]
        panel.text(0.5, 0.5, "\n".join(missing), ha="center", va="center", color=PALE, fontsize=13)
    if not _few(rows):
        _key(figure, rows)
    return figure


def _few(rows: Rows) -> bool:
    return len({row["method"] for row in rows}) <= FEW


def _key(figure: Figure, rows: Rows) -> None:
    """What colours and markers mean, for panels with too many curves to label."""
    contacts = {str(row["contacts"]) for row in rows if "contacts" in row}
    integrators = {str(row["integrator"]) for row in rows if "integrator" in row}
    entries = [
        Line2D([], [], color=colour, lw=4, label=name)
        for name, colour in CONTACTS.items()
        if name in contacts
    ]
    entries += [
        Line2D([], [], color=INK, lw=0, marker=marker, label=name.replace("_", " "))
        for name, marker in MARKER.items()
        if name in integrators
    ]
    peers = dict.fromkeys(str(row["method"]) for row in rows if "contacts" not in row)
    entries += [
        Line2D([], [], color=PEER, ls="--", marker=marker, label=name)
        for name, marker in zip(peers, PEER_MARKERS, strict=False)
    ]
    height = figure.get_size_inches()[1]
    figure.legend(
        handles=entries, loc="upper left", bbox_to_anchor=(0.005, 1.0 - 1.02 / height), ncols=len(entries),
        fontsize=12, columnspacing=1.6, handletextpad=0.5,
    )  # fmt: skip


def _floor(values: Sequence[float]) -> float:
    """Where exact zeros are drawn, since a logarithmic axis has no place for them: left of all others."""
    return min((value for value in values if value > 0.0), default=1e-3) / 10.0


def _panel(axes: Axes, name: str, label: str, rows: Rows) -> None:
    usable = [row for row in rows if name in row and "cost" in row]
    floor = _floor([float(row[name]) for row in usable])
    axes.set_xscale("log")
    axes.set_yscale("log")
    best = front((max(float(row[name]), floor), float(row["cost"])) for row in usable)
    axes.step(
        *zip(*best, strict=True), where="post", color=FRONT, linewidth=9, zorder=1, solid_capstyle="round"
    )
    peers = list(dict.fromkeys(str(row["method"]) for row in usable if "contacts" not in row))
    labels = [
        _curve(axes, method, name, floor, [row for row in usable if row["method"] == method], peers)
        for method in dict.fromkeys(str(row["method"]) for row in usable)
    ]
    axes.set_xlabel(label)
    axes.set_ylabel("Cost: ns per ball and simulated second")
    low, high = axes.get_xlim()
    axes.set_xlim(low / 1.5, high * (high / low) ** (0.42 if _few(rows) else 0.05))
    if any(float(row[name]) <= floor for row in usable):
        axes.axvline(floor, color=PALE, linewidth=0.8, linestyle=":")
        axes.annotate(
            "exactly 0", (floor, 0.98), xycoords=("data", "axes fraction"), xytext=(4, 0),
            textcoords="offset points", fontsize=9, color=PALE, va="top",
        )  # fmt: skip
    if _few(rows):
        write_labels(axes, labels)


def _curve(  # noqa: PLR0917 - an axis and what is on it
    axes: Axes, method: str, name: str, floor: float, rows: Sequence[Row], peers: Sequence[str]
) -> Label:
    ordered = sorted(rows, key=lambda row: float(row["tick_rate"]))
    error = [max(float(row[name]), floor) for row in ordered]
    cost = [float(row["cost"]) for row in ordered]
    if "contacts" in ordered[0]:
        contacts, integrator = str(ordered[0]["contacts"]), str(ordered[0]["integrator"])
        colour, marker, line = CONTACTS[contacts], MARKER[integrator], "-"
    else:
        colour, marker, line = PEER, PEER_MARKERS[peers.index(method) % len(PEER_MARKERS)], "--"
    axes.plot(
        error, cost, line, color=colour, marker=marker, markeredgecolor="white", markeredgewidth=0.7, zorder=3
    )
    return Label(method, error[0], cost[0], colour if colour != PEER else INK)
