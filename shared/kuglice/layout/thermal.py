"""Dense discs of one size: a hexagonal lattice with vacancies, melted by Monte Carlo moves.

The moves are those of Anderson et al., J. Comput. Phys. 254 (2013) 27: a checkerboard of cells, each holding
at most one disc that may not leave it, lets non-neighbours move at once; the grid shifts from sweep to sweep.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kuglice.layout.sequential import inner
from kuglice.layout.slot_grid import CLEARANCE, SlotGrid
from kuglice.layout.stream import RandomStream

__all__ = ["melt"]

Floats = NDArray[np.float64]
Area = tuple[float, float, float, float]

MOST_SWEEPS = 50
MOVES = 3_000_000
"""Disc moves in total: a million discs get few sweeps, and need few, because motion melts the rest."""
STRIDE = 3
"""Cells between discs that move at once: two whole cells of 1.414 radii are more than a diameter."""
NEIGHBOURS = [
    (across, along)
    for along in range(-2, 3)
    for across in range(-2, 3)
    if abs(along) + abs(across) not in (0, 4)
]
"""Cells in which a disc can be met; the corners are too far away."""


class Room(NamedTuple):
    """Where centres may lie, and what is in the way."""

    left: float
    bottom: float
    width: float
    height: float
    radius: float
    present: list[SlotGrid]

    def free(self, place: Floats) -> NDArray[np.bool_]:
        """(n,) whether a disc there lies in the room and overlaps nothing that was there before."""
        good = (place[:, 0] >= self.left) & (place[:, 0] <= self.left + self.width)
        good &= (place[:, 1] >= self.bottom) & (place[:, 1] <= self.bottom + self.height)
        for obstacles in self.present:
            good &= ~obstacles.overlapped(place, np.full(len(place), self.radius))
        return good


def melt(
    area: Area, radius: float, count: int, present: list[SlotGrid], stream: RandomStream
) -> Floats | None:
    """(count, 2) centres, or None if a hexagonal lattice in this area has too few free places."""
    left, bottom, width, height = (float(part[0]) for part in inner(area, np.array([radius])))
    room = Room(left, bottom, width, height, radius, present)
    lattice = _lattice(room, count, even=True) or _lattice(room, count, even=False)
    if lattice is None:
        return None
    position, gap = lattice
    for _ in range(min(MOST_SWEEPS, max(4, MOVES // count))):
        _sweep(position, room, min(max(gap, 0.1 * radius), 0.7 * radius), stream)
    return position


def _lattice(room: Room, count: int, even: bool) -> tuple[Floats, float] | None:
    """The widest lattice with enough free places, and the gap between its discs.

    An even one keeps its triangles nearly equilateral; otherwise rows lie as close as discs permit.
    """
    diameter = 2.0 * room.radius * CLEARANCE
    if room.width <= 0 or room.height < 0:
        return None
    # Somewhat fewer columns than would hold the discs if there were no walls and nothing present.
    columns = max(1, int(math.sqrt(count * room.width / max(room.height, diameter) * 0.75)))
    while True:
        spacing = room.width / (columns - 0.5)
        if spacing < diameter:
            return None
        least_rise = spacing * math.sqrt(3.0) / 2.0
        if not even:
            apart = math.sqrt(max(diameter * diameter - 0.25 * spacing * spacing, 0.0))
            least_rise = max(apart, 0.5 * diameter) * CLEARANCE
        rows = int(room.height / least_rise) + 1
        rise = room.height / (rows - 1) if rows > 1 else 0.0
        if rows * columns >= count:
            row, column = np.divmod(np.arange(rows * columns), columns)
            place = np.empty((rows * columns, 2))
            place[:, 0] = room.left + (column + 0.5 * (row % 2)) * spacing
            place[:, 1] = room.bottom + row * rise
            place = place[room.free(place)]
            if len(place) >= count:
                # Spreads the vacancies evenly.
                chosen = np.arange(count) * len(place) // count
                return place[chosen], spacing - diameter
        columns += 1


def _sweep(position: Floats, room: Room, step: float, stream: RandomStream) -> None:
    """Let every disc try one move of up to `step` in x and y, in place."""
    side = 1.414 * room.radius
    shift = stream.take(2) * side - (room.left, room.bottom)
    cell = _cells(position, shift, side)
    columns = int(room.width / side) + 7
    slots = np.full(columns * (int(room.height / side) + 7), -1, dtype=np.int64)
    key = cell[:, 1] * columns + cell[:, 0]
    slots[key] = np.arange(len(position))
    colour = cell[:, 1] % STRIDE * STRIDE + cell[:, 0] % STRIDE
    moves = step * (2.0 * stream.pairs(len(position)) - 1.0)
    least = 2.0 * room.radius * CLEARANCE
    for turn in range(STRIDE * STRIDE):
        who = np.flatnonzero(colour == turn)
        moved = position[who] + moves[who]
        good = (_cells(moved, shift, side) == cell[who]).all(axis=1) & room.free(moved)
        who, moved = who[good], moved[good]
        for across, along in NEIGHBOURS:
            other = slots[key[who] + along * columns + across]
            apart = moved - position[other]
            clear = apart[:, 0] * apart[:, 0] + apart[:, 1] * apart[:, 1] >= least * least
            good = (other < 0) | clear
            who, moved = who[good], moved[good]
        position[who] = moved


def _cells(position: Floats, shift: Floats, side: float) -> NDArray[np.int64]:
    """(n, 2) column and row; a margin of two empty cells saves every test for the edge of the grid."""
    return ((position + shift) / side).astype(np.int64) + 2
