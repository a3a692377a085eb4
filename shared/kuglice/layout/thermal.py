"""Dense discs of one size: a hexagonal lattice with vacancies, melted by Monte Carlo moves.

The moves are those of Anderson et al., J. Comput. Phys. 254 (2013) 27: a checkerboard of cells, each holding at
most one disc that may not leave it, lets non-neighbours move at once; the grid shifts from sweep to sweep.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from kuglice.layout.sequential import inner
from kuglice.layout.slot_grid import CLEARANCE, SlotGrid
from kuglice.layout.stream import RandomStream

__all__ = ["melt"]

Floats = NDArray[np.float64]
Area = tuple[float, float, float, float]

MOST_SWEEPS = 100
MOVES = 8_000_000
"""Disc moves in total: a million discs get few sweeps, and need few, because motion melts the rest."""
STRIDE = 3
"""Cells between discs that move at once: two whole cells of 1.414 radii are more than a diameter."""


def melt(
    area: Area, radius: float, count: int, present: list[SlotGrid], stream: RandomStream
) -> Floats | None:
    """(count, 2) centres, or None if a hexagonal lattice in this area has too few free places."""
    lattice = _lattice(area, radius, count, present)
    if lattice is None:
        return None
    position, gap = lattice
    side = 1.414 * radius
    for _ in range(min(MOST_SWEEPS, max(4, MOVES // count))):
        _sweep(position, area, radius, side, min(gap, 0.5 * side), present, stream)
    return position


def _lattice(area: Area, radius: float, count: int, present: list[SlotGrid]) -> tuple[Floats, float] | None:
    """The widest lattice with enough free places, and the gap between its discs."""
    left, bottom, width, height = (float(part[0]) for part in inner(area, np.array([radius])))
    diameter = 2.0 * radius * CLEARANCE
    if width < 0 or height < 0:
        return None
    # The first guess is a lattice that would hold the discs if there were no walls and nothing present.
    columns = max(1, int(math.sqrt(count * width / max(height, diameter) * 0.75)))
    while True:
        spacing = width / (columns - 0.5) if columns > 1 else width
        if columns > 1 and spacing < diameter:
            return None
        least_rise = spacing * math.sqrt(3.0) / 2.0 if columns > 1 else diameter
        rows = int(height / least_rise) + 1
        rise = height / (rows - 1) if rows > 1 else 0.0
        if rows * columns >= count:
            row, column = np.divmod(np.arange(rows * columns), columns)
            place = np.empty((rows * columns, 2))
            place[:, 0] = left + (column + 0.5 * (row % 2)) * (spacing if columns > 1 else 0.0)
            place[:, 1] = bottom + row * rise
            for obstacles in present:
                place = place[~obstacles.overlapped(place, np.full(len(place), radius))]
            if len(place) >= count:
                # Spreads the vacancies evenly.
                chosen = np.arange(count) * len(place) // count
                return place[chosen], spacing - diameter
        columns += 1


def _sweep(
    position: Floats,
    area: Area,
    radius: float,
    side: float,
    step: float,
    present: list[SlotGrid],
    stream: RandomStream,
) -> None:
    """Let every disc try one move of up to `step` in x and y, in place."""
    left, bottom, width, height = (float(part[0]) for part in inner(area, np.array([radius])))
    shift = stream.take(2) * side
    # A margin of empty cells saves every test for the edge of the grid.
    cell = ((position - (left, bottom) + shift) / side).astype(np.int64) + 2
    columns = int(width / side) + 7
    slots = np.full(columns * (int(height / side) + 7), -1, dtype=np.int64)
    key = cell[:, 1] * columns + cell[:, 0]
    slots[key] = np.arange(len(position))
    colour = cell[:, 1] % STRIDE * STRIDE + cell[:, 0] % STRIDE
    drawn = stream.pairs(len(position))
    least = 2.0 * radius * CLEARANCE
    for turn in range(STRIDE * STRIDE):
        who = np.flatnonzero(colour == turn)
        moved = position[who] + step * (2.0 * drawn[who] - 1.0)
        corner = ((moved - (left, bottom) + shift) / side).astype(np.int64) + 2
        good = (corner == cell[who]).all(axis=1)
        good &= (moved[:, 0] >= left) & (moved[:, 0] <= left + width)
        good &= (moved[:, 1] >= bottom) & (moved[:, 1] <= bottom + height)
        who, moved = who[good], moved[good]
        for obstacles in present:
            free = ~obstacles.overlapped(moved, np.full(len(moved), radius))
            who, moved = who[free], moved[free]
        for along in range(-2, 3):
            for across in range(-2, 3):
                if abs(along) + abs(across) in (0, 4):
                    continue
                other = slots[key[who] + along * columns + across]
                apart = moved - position[other]
                clear = apart[:, 0] * apart[:, 0] + apart[:, 1] * apart[:, 1] >= least * least
                free = (other < 0) | clear
                who, moved = who[free], moved[free]
        position[who] = moved
