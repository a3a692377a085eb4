"""Random sequential addition: propose places, keep those that are free, propose again for the rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice.layout.slot_grid import SlotGrid
from kuglice.layout.stream import RandomStream

__all__ = ["add_sequentially", "inner"]

Floats = NDArray[np.float64]
Area = tuple[float, float, float, float]

PROPOSALS_PER_BALL = 400
"""Beyond this the area counts as full: random sequential addition jams at a packing of 0.547."""
LEAST_PROPOSALS = 200_000
BATCH = 4096
"""Few missing balls propose several places each, so that a round is never small."""


def add_sequentially(
    area: Area, radius: Floats, present: list[SlotGrid], stream: RandomStream
) -> Floats | None:
    """(n, 2) centres of discs inside the area, free of each other and of what is present; None if it is full.

    Large discs are placed first, in classes of a factor of two: small ones find room between them.
    """
    position = np.empty((len(radius), 2))
    grids = list(present)
    for chosen in _classes(radius):
        grid = SlotGrid(area, float(radius[chosen].min()), float(radius[chosen].max()), len(chosen))
        placed = _fill(area, radius[chosen], grid, grids, stream)
        if placed is None:
            return None
        position[chosen] = placed
        grids.append(grid)
    return position


def inner(area: Area, radius: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Where centres may lie: left, bottom, width, height per disc, a hair inside against rounding."""
    left, bottom, right, top = area
    hair = 1e-12 * (abs(left) + abs(right) + abs(bottom) + abs(top))
    reach = radius + hair
    return left + reach, bottom + reach, (right - left) - 2.0 * reach, (top - bottom) - 2.0 * reach


def _classes(radius: Floats) -> list[NDArray[np.intp]]:
    """Indices by radius within a factor of two, largest first."""
    classes = []
    bound = float(radius.max()) if radius.size else 0.0
    left = np.arange(len(radius))
    while left.size:
        large = radius[left] > bound / 2.0
        if large.any():
            classes.append(left[large])
            left = left[~large]
        bound /= 2.0
    return classes


def _fill(
    area: Area, radius: Floats, grid: SlotGrid, present: list[SlotGrid], stream: RandomStream
) -> Floats | None:
    position = np.empty((len(radius), 2))
    missing = np.arange(len(radius))
    allowed = max(PROPOSALS_PER_BALL * len(radius), LEAST_PROPOSALS)
    while missing.size:
        tries = max(1, BATCH // missing.size)
        proposing = np.repeat(missing, tries)
        allowed -= proposing.size
        if allowed < 0:
            return None
        left, bottom, width, height = inner(area, radius[proposing])
        drawn = stream.pairs(proposing.size)
        place = np.empty((proposing.size, 2))
        place[:, 0] = left + drawn[:, 0] * width
        place[:, 1] = bottom + drawn[:, 1] * height
        for obstacles in (*present, grid):
            free = ~obstacles.overlapped(place, radius[proposing])
            place, proposing = place[free], proposing[free]
        kept = _compatible(place, radius, proposing, grid)
        place, proposing = place[kept], proposing[kept]
        grid.insert(place, radius[proposing])
        position[proposing] = place
        waiting = np.ones(len(radius), dtype=bool)
        waiting[proposing] = False
        missing = missing[waiting[missing]]
    return position


def _compatible(
    place: Floats, radius: Floats, proposing: NDArray[np.intp], grid: SlotGrid
) -> NDArray[np.intp]:
    """Indices of proposals that overlap no earlier proposal of the same round; one per ball and per cell."""
    _, first = np.unique(proposing, return_index=True)
    _, alone = np.unique(grid.key(place[first]), return_index=True)
    kept = first[np.sort(alone)]
    round_grid = grid.like()
    round_grid.insert(place[kept], radius[proposing[kept]])
    overlapped = round_grid.overlapped(
        place[kept], radius[proposing[kept]], below=np.arange(len(kept), dtype=np.int64)
    )
    return kept[~overlapped]
