"""A grid compiled by numba, what optimised Python reaches: square cells, a counting sort, one thread."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice.extras import extra
from kuglice.lab.running import CannotRunError
from kuglice.scene import Scene

with extra("peers"):
    import numba

__all__ = ["NumbaGrid"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Arrays = tuple[Floats, Floats, Floats, Floats]
Numbers = tuple[float, ...]
Grid = tuple[float, float, float, int, int]


class NumbaGrid:
    """Move, bin, exchange velocities pair after pair, flip at walls."""

    def __init__(self, scene: Scene) -> None:
        if scene.forces and {force.kind for force in scene.forces} != {"gravity"}:
            raise CannotRunError("only gravity is written for it")
        pulls = [(force.x, force.y) for force in scene.forces if force.kind == "gravity"]
        self._gravity = (float(sum(x for x, _ in pulls)), float(sum(y for _, y in pulls)))
        self._box = tuple(map(float, scene.box))
        self._dt = 1.0 / scene.tick_rate
        balls = scene.balls
        self._balls: Arrays = (
            balls.position.copy(),
            balls.velocity.copy(),
            balls.radius.copy(),
            balls.mass.copy(),
        )
        self._count = 0
        # Compilation is no part of a step.
        self.run(0)

    def run(self, ticks: int) -> None:
        """That many steps."""
        self._count += run(self._balls, self._box, self._gravity, self._dt, ticks)

    @property
    def position(self) -> NDArray[np.float64]:
        """(n, 2)."""
        return self._balls[0].copy()

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n, 2)."""
        return self._balls[1].copy()

    @property
    def collisions(self) -> int:
        """Pairs that exchanged velocities."""
        return self._count


def _bin(p: Floats, grid: Grid, cell: Integers, start: Integers, order: Integers) -> None:
    """Counting sort: order[start[k]:start[k + 1]] are the balls of cell k. A ring of cells is for strays."""
    left, bottom, side, columns, rows = grid
    start[:] = 0
    for i in range(len(p)):
        column = min(max(int((p[i, 0] - left) / side) + 1, 0), columns - 1)
        row = min(max(int((p[i, 1] - bottom) / side) + 1, 0), rows - 1)
        cell[i] = row * columns + column
        start[cell[i] + 1] += 1
    for k in range(columns * rows):
        start[k + 1] += start[k]
    for i in range(len(p) - 1, -1, -1):
        start[cell[i] + 1] -= 1
        order[start[cell[i] + 1]] = i
    # The sort has moved each start one place up.
    for k in range(columns * rows):
        start[k] = start[k + 1]
    start[columns * rows] = len(p)


def _exchange(i: int, j: int, balls: Arrays) -> int:
    p, v, radius, mass = balls
    dx, dy = p[j, 0] - p[i, 0], p[j, 1] - p[i, 1]
    reach = radius[i] + radius[j]
    square = dx * dx + dy * dy
    if square >= reach * reach or square == 0.0:
        return 0
    approach = dx * (v[j, 0] - v[i, 0]) + dy * (v[j, 1] - v[i, 1])
    if approach >= 0.0:
        return 0
    share = 2.0 * approach / (square * (mass[i] + mass[j]))
    v[i, 0] += share * mass[j] * dx
    v[i, 1] += share * mass[j] * dy
    v[j, 0] -= share * mass[i] * dx
    v[j, 1] -= share * mass[i] * dy
    return 1


def _collide(balls: Arrays, columns: int, rows: int, start: Integers, order: Integers) -> int:
    """Each cell with itself, its right neighbour and the three above."""
    count = 0
    for here in range(columns * (rows - 1) - 1):
        for a in range(start[here], start[here + 1]):
            for b in range(a + 1, start[here + 2]):
                count += exchange(order[a], order[b], balls)
            # Cells of one row are neighbours in memory too; wrapped ones are too far apart to touch.
            for b in range(start[here + columns - 1], start[here + columns + 2]):
                count += exchange(order[a], order[b], balls)
    return count


def _run(balls: Arrays, box: Numbers, gravity: Numbers, dt: float, ticks: int) -> int:
    p, v, radius, mass = balls
    left, bottom, right, top = box
    side = 2.0 * radius.max()
    columns, rows = int((right - left) / side) + 3, int((top - bottom) / side) + 3
    cell, order = np.empty(len(p), np.int64), np.empty(len(p), np.int64)
    # Three more than cells: the last row has no row above it.
    start = np.empty(columns * rows + 1, np.int64)
    count = 0
    for _ in range(ticks):
        for i in range(len(p)):
            v[i, 0] += gravity[0] * dt
            v[i, 1] += gravity[1] * dt
            p[i, 0] += v[i, 0] * dt
            p[i, 1] += v[i, 1] * dt
        bin_balls(p, (left, bottom, side, columns, rows), cell, start, order)
        count += collide((p, v, radius, mass), columns, rows, start, order)
        for i in range(len(p)):
            r = radius[i]
            if (p[i, 0] - r < left and v[i, 0] < 0.0) or (p[i, 0] + r > right and v[i, 0] > 0.0):
                v[i, 0] = -v[i, 0]
            if (p[i, 1] - r < bottom and v[i, 1] < 0.0) or (p[i, 1] + r > top and v[i, 1] > 0.0):
                v[i, 1] = -v[i, 1]
    return count


# Calls, not decorators: numba has no types, and may not be there for a type checker.
bin_balls = numba.njit(cache=True)(_bin)
exchange = numba.njit(cache=True)(_exchange)
collide = numba.njit(cache=True)(_collide)
run = numba.njit(cache=True)(_run)
