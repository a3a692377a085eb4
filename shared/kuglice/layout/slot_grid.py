"""A uniform grid over placed discs, for whole arrays of questions "does this disc overlap one of you?"."""

from __future__ import annotations

import copy
import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["CLEARANCE", "SlotGrid"]

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Area = tuple[float, float, float, float]

CLEARANCE = 1.0 + 1e-12
"""Discs keep this factor apart, so that rounding in any other formula cannot find them overlapping."""
EMPTY = -1
SPARSEST = 4.0
"""Cells per disc at most: a few small discs in a wide box must not cost a huge grid."""


class SlotGrid:
    """Cells of a side at which discs of this radius rarely share one; each layer holds one disc per cell."""

    def __init__(self, area: Area, smallest: float, largest: float, expected: int) -> None:
        left, bottom, right, top = area
        widest = math.sqrt((right - left) * (top - bottom) / (SPARSEST * max(expected, 1)))
        self.side = max(smallest * 1.414, widest)
        self.largest = largest
        self._left, self._bottom = left, bottom
        self._columns = int((right - left) / self.side) + 1
        self._rows = int((top - bottom) / self.side) + 1
        self._layers: list[NDArray[np.int32]] = []
        self.position: Floats = np.empty((0, 2))
        self.radius: Floats = np.empty(0)

    def like(self) -> SlotGrid:
        """An empty grid of the same cells."""
        made = copy.copy(self)
        made._layers, made.position, made.radius = [], np.empty((0, 2)), np.empty(0)
        return made

    def cells(self, position: Floats) -> tuple[Indices, Indices]:
        """Column and row of each point; what lies outside the area counts to the outermost cell."""
        column = ((position[:, 0] - self._left) / self.side).astype(np.int64)
        row = ((position[:, 1] - self._bottom) / self.side).astype(np.int64)
        return column.clip(0, self._columns - 1), row.clip(0, self._rows - 1)

    def key(self, position: Floats) -> Indices:
        """One number per cell."""
        column, row = self.cells(position)
        return row * self._columns + column

    def insert(self, position: Floats, radius: Floats) -> None:
        """Add discs; those that share a cell go to further layers."""
        first = len(self.radius)
        self.position = np.concatenate([self.position, position])
        self.radius = np.concatenate([self.radius, radius])
        pending = np.arange(first, len(self.radius))
        key = self.key(position)
        depth = 0
        while pending.size:
            if depth == len(self._layers):
                self._layers.append(np.full(self._columns * self._rows, EMPTY, dtype=np.int32))
            layer = self._layers[depth]
            free = layer[key] == EMPTY
            # The first disc of each cell takes the slot: which of several writes wins is not numpy's promise.
            taken, chosen = np.unique(key[free], return_index=True)
            settled = np.flatnonzero(free)[chosen]
            layer[taken] = pending[settled]
            waiting = np.ones(pending.size, dtype=bool)
            waiting[settled] = False
            pending, key = pending[waiting], key[waiting]
            depth += 1

    def overlapped(self, position: Floats, radius: Floats, below: Indices | None = None) -> NDArray[np.bool_]:
        """(n,) whether each disc overlaps a stored one, of an index less than `below` if that is given."""
        hit = np.zeros(len(radius), dtype=bool)
        if not len(radius) or not self._layers:
            return hit
        alive = np.arange(len(radius))
        column, row = self.cells(position)
        for across, along in self._window(self.largest + float(radius.max())):
            at_column, at_row = column[alive] + across, row[alive] + along
            inside = (at_column >= 0) & (at_column < self._columns) & (at_row >= 0) & (at_row < self._rows)
            asking = alive[inside]
            key = at_row[inside] * self._columns + at_column[inside]
            for layer in self._layers:
                other = layer[key]
                met = other != EMPTY
                if below is not None:
                    met &= other < below[asking]
                who, whom = asking[met], other[met]
                dx = position[who, 0] - self.position[whom, 0]
                dy = position[who, 1] - self.position[whom, 1]
                least = (radius[who] + self.radius[whom]) * CLEARANCE
                hit[who[dx * dx + dy * dy < least * least]] = True
            alive = alive[~hit[alive]]
        return hit

    def _window(self, reach: float) -> list[tuple[int, int]]:
        """Offsets of the cells that a disc can touch, nearest first, because a hit ends the search."""
        widest = math.ceil(reach / self.side)
        offsets = [
            (across, along)
            for across in range(-widest, widest + 1)
            for along in range(-widest, widest + 1)
            if max(abs(across) - 1, 0) ** 2 + max(abs(along) - 1, 0) ** 2 < (reach / self.side) ** 2
        ]
        return sorted(offsets, key=lambda offset: offset[0] ** 2 + offset[1] ** 2)
