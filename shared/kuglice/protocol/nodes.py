"""The quadtree of regions as views see it: nodes, their paths and rectangles, and which of them cover what.

A node of depth d is a number of d digits in base 4, the digits of its path from the root: 0 left bottom, 1 right
bottom, 2 left top, 3 right top. It owns its left and bottom edge, and at the edge of the box all that is outside.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from math import floor

__all__ = ["Nodes", "Rectangle"]

Rectangle = tuple[float, float, float, float]
"""Left, bottom, right, top."""
Path = tuple[int, ...]


@dataclass(frozen=True)
class Nodes:
    """All nodes of one depth over a box."""

    box: Rectangle
    depth: int

    @property
    def count(self) -> int:
        """How many there are."""
        return 1 << 2 * self.depth

    def path(self, node: int) -> Path:
        """From the root down."""
        return tuple(node >> 2 * level & 3 for level in reversed(range(self.depth)))

    def rectangle(self, node: int) -> Rectangle:
        """What the node covers within the box."""
        column = row = 0
        for quarter in self.path(node):
            column, row = 2 * column + (quarter & 1), 2 * row + (quarter >> 1)
        left, bottom, right, top = self.box
        width, height = (right - left) / 2**self.depth, (top - bottom) / 2**self.depth
        x, y = left + column * width, bottom + row * height
        return x, y, x + width, y + height

    def cover(self, rectangle: Rectangle) -> frozenset[int]:
        """The nodes that hold every point of the rectangle, at least one."""
        left, bottom, right, top = self.box
        columns = self._span(rectangle[0], rectangle[2], left, right)
        rows = self._span(rectangle[1], rectangle[3], bottom, top)
        return frozenset(_spread(column) | _spread(row) << 1 for row in rows for column in columns)

    def _span(self, low: float, high: float, begin: float, end: float) -> range:
        side = 2**self.depth
        first, last = ((edge - begin) * (side / (end - begin)) for edge in (low, high))
        # Bounded before it becomes a whole number, which an infinite one cannot.
        first, last = (min(max(place, 0.0), side - 1.0) for place in (first, last))
        return range(floor(first), max(floor(first), floor(last)) + 1)

    def merged(self, nodes: Collection[int]) -> frozenset[Path]:
        """The fewest paths that have just these nodes below them, or are them."""
        found: set[Path] = set()
        level = set(nodes)
        for depth in range(self.depth, -1, -1):
            parents = {node >> 2 for node in level} if depth else set()
            whole = {parent for parent in parents if all(parent << 2 | part in level for part in range(4))}
            rest = Nodes(self.box, depth)
            found |= {rest.path(node) for node in level if depth == 0 or node >> 2 not in whole}
            level = whole
        return frozenset(found)


def _spread(number: int) -> int:
    """Bits side by side to places 0, 2, 4, ..."""
    return sum((number >> bit & 1) << 2 * bit for bit in range(number.bit_length()))
