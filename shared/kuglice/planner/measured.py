"""The committed table of errors and costs, and how it is read between its points.

`make chart` measures it again: kuglice.lab.calibration says how.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterable
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "contact_error",
    "contacts_cost",
    "drift",
    "force_error",
    "integrator_cost",
    "machine",
    "pile_cost",
    "sinking",
]

Floats = NDArray[np.float64]

FILE = "measured.csv"
TINY = 1e-300
"""An error that was measured as 0 has a logarithm too."""

Row = dict[str, str]
Curve = list[tuple[float, float]]


@cache
def _content() -> tuple[str, list[Row]]:
    text = files("kuglice.planner").joinpath(FILE).read_text(encoding="utf-8").splitlines()
    remarks = [line.removeprefix("#").strip() for line in text if line.startswith("#")]
    return remarks[0], list(csv.DictReader(line for line in text if not line.startswith("#")))


def machine() -> str:
    """The one on which the costs were measured."""
    return _content()[0]


@cache
def _curve(x: str, **wanted: str) -> Curve:
    """Points (x, value) of the rows that have all these values."""
    return sorted(
        (float(row[x]), float(row["value"]))
        for row in _content()[1]
        if all(row[name] == value for name, value in wanted.items())
    )


@cache
def _curves(by: str, **wanted: str) -> dict[float, Curve]:
    """One curve for each value of `by`."""
    values = {row[by] for row in _content()[1] if all(row[name] == value for name, value in wanted.items())}
    return {float(value): _curve("x", **{by: value}, **wanted) for value in values}


@cache
def _value(**wanted: str) -> float:
    return next(
        float(row["value"])
        for row in _content()[1]
        if all(row[name] == value for name, value in wanted.items())
    )


def contact_error(contacts: str, packing: float, move: float) -> float:
    """In radii at one collision per ball; `move` is speed * tick / radius. Between packings by logarithms."""
    curves = _curves("packing", kind="contact error", contacts=contacts)
    return _between(packing, curves, lambda curve: _power(curve, move, steepest=1.0))


def force_error(integrator: str, force: str, step: Floats) -> Floats:
    """In amplitudes per radian; `step` is omega * dt. `force`: spring, orbit, velocity or uniform."""
    return _powers(_curve("x", kind="force error", integrator=integrator, force=force), step)


def drift(integrator: str, force: str, step: Floats) -> Floats:
    """Relative change of energy per radian, or per time of fall; `step` is omega * dt. `force`: spring, uniform."""
    return _powers(_curve("x", kind="drift", integrator=integrator, force=force), step)


def sinking(contacts: str) -> float:
    """Deepest overlap, in radii, of balls that weigh on each other."""
    return _value(kind="sinking", contacts=contacts)


def contacts_cost(contacts: str, broadphase: str, balls: int, hits: float) -> float:
    """ns per ball-step without forces; `hits` is the collisions per ball and tick."""
    curves = _curves("balls", kind="cost", contacts=contacts, broadphase=broadphase)
    return _between(max(balls, 1), curves, lambda curve: _line(curve, hits), open_ended=True)


def pile_cost(contacts: str) -> tuple[float, float]:
    """ns per ball-step of balls that lie, one and two deep; 0 for treatments that carry none."""
    costs = [cost for _, cost in _curve("x", kind="pile cost", contacts=contacts)]
    return min(costs, default=0.0), max(costs, default=0.0)


def integrator_cost(integrator: str) -> float:
    """ns that it adds to a ball-step if there is a force."""
    return _value(kind="integrator cost", integrator=integrator)


def _power(curve: Curve, x: float, steepest: float = math.inf) -> float:
    """Straight between and beyond the points in logarithms, which is what a convergence order is.

    Below the first point, no order higher than `steepest` is trusted.
    """
    after = next((index for index, (place, _) in enumerate(curve) if place >= x), len(curve) - 1)
    (x0, y0), (x1, y1) = curve[max(after - 1, 0)], curve[max(after, 1)]
    slope = (math.log(max(y1, TINY)) - math.log(max(y0, TINY))) / (math.log(x1) - math.log(x0))
    if x < x0:
        slope = min(slope, steepest)
    return math.exp(math.log(max(y0, TINY)) + slope * (math.log(x) - math.log(x0)))


def _powers(curve: Curve, x: Floats) -> Floats:
    """`_power` of many."""
    places, values = np.log(np.array(curve)[:, 0]), np.log(np.maximum(np.array(curve)[:, 1], TINY))
    after = np.clip(np.searchsorted(places, np.log(x)), 1, len(curve) - 1)
    slope = (values[after] - values[after - 1]) / (places[after] - places[after - 1])
    found: Floats = np.exp(values[after - 1] + slope * (np.log(x) - places[after - 1]))
    return found


def _line(curve: Curve, x: float) -> float:
    (x0, y0), (x1, y1) = curve[0], curve[-1]
    if x1 <= x0:
        return y1
    # Costs do not fall below the calmest that was measured.
    return y0 + max(0.0, y1 - y0) / (x1 - x0) * max(0.0, x - x0)


def _between(
    value: float, curves: dict[float, Curve], read: Callable[[Curve], float], *, open_ended: bool = False
) -> float:
    """Between the two nearest curves by logarithms; outside, the last one (or its trend, if `open_ended`)."""
    places = sorted(curves)
    inside = value if open_ended else min(max(value, places[0]), places[-1])
    points = [(place, read(curves[place])) for place in _nearest(places, inside)]
    return _power(points, inside) if len(points) > 1 else points[0][1]


def _nearest(places: list[float], value: float) -> Iterable[float]:
    after = next((index for index, place in enumerate(places) if place >= value), len(places) - 1)
    return places[max(after - 1, 0) : max(after, 1) + 1]
