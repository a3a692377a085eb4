"""Which regions a view wants, and how often: all that cover it, and if that is too much, the far ones less often.

A region that has just come into sight is asked for at full pace until it was told of once: at a slow pace there would
be a hole for as long as that takes to come round, up to 1.6 s.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from kuglice.protocol import PACES, Nodes, Rectangle

__all__ = ["Interest"]

KEPT_SHARE = 0.9
"""Of the budget: what is told grows and shrinks between two looks at it."""
SPARE_SHARE = 0.75
FIRST_SECONDS = 0.1
"""Of the budget, for first words at a time."""
BEYOND_SMOOTHING = 0.3
SMOOTHING = 0.2
ENVELOPE_BYTES = 16
BALL_BYTES = 8


class Interest:
    """Of one view in the nodes of a quadtree.

    `rate`: messages per second about a node at pace 0; `balls`: of the whole world, for a guess at what is not
    known yet.
    """

    def __init__(self, nodes: Nodes, *, rate: float, balls: int, budget: float | None) -> None:
        self._nodes = nodes
        self._rate = rate
        self._guess = ENVELOPE_BYTES + BALL_BYTES * balls / nodes.count
        self._budget = budget
        self._sizes: dict[int, float] = {}
        self.paces: dict[int, int] = {}
        """Node -> pace, of the nodes that are wanted."""
        self._first: frozenset[int] = frozenset()
        self._bytes = 0
        self._beyond = 0.0
        self.left_out = 0
        """Nodes that would be wanted, if there were bytes for them."""

    def note(self, node: int, size: int) -> None:
        """A message about that node took so many bytes."""
        known = self._sizes.get(node)
        self._bytes += size
        self._sizes[node] = size if known is None else known + SMOOTHING * (size - known)

    def passed(self, seconds: float) -> None:
        """So long after the last call: what came beyond the paces, first words above all, is to be expected again."""
        beyond = self._bytes / seconds - self._cost(self.paces)
        self._beyond = max(0.0, self._beyond + BEYOND_SMOOTHING * (beyond - self._beyond))
        self._bytes = 0

    @property
    def asked_for(self) -> dict[int, int]:
        """Node -> pace, as it is to be asked for now: first words come sooner than at the paces that last."""
        return self.paces | dict.fromkeys(self._first, 0)

    @property
    def complete(self) -> bool:
        """Whether all that is wanted was told of."""
        return self.paces.keys() <= self._sizes.keys()

    @property
    def first_words_came(self) -> bool:
        """Of something that need be told no more at full pace; others may have their turn."""
        return not self._first.isdisjoint(self._sizes)

    @property
    def bytes_per_second(self) -> float:
        """What is to be expected."""
        return self._cost(self.paces) + self._beyond

    @property
    def out_of_balance(self) -> bool:
        """Whether choosing again would pay: more is told than may be, or much less than could be."""
        if self._budget is None:
            return False
        share = self.bytes_per_second / self._budget
        slowed = self.left_out > 0 or any(self.paces.values())
        return share > 1 or (slowed and share < SPARE_SHARE)

    def choose(self, view: Rectangle, margin: float) -> bool:
        """Look at `view` and a margin around it. Whether anything has changed.

        The nodes of the view itself, seen from its middle, come before those of the margin.
        """
        left, bottom, right, top = view
        wide = (left - margin, bottom - margin, right + margin, top + margin)
        inner, outer = self._nodes.cover(view), self._nodes.cover(wide)
        middle = ((left + right) / 2, (bottom + top) / 2)
        near_first = sorted(outer, key=lambda node: (node not in inner, self._distance(node, middle), node))
        paces = self._affordable(near_first)
        before = self.asked_for
        self.paces, self.left_out = paces, len(near_first) - len(paces)
        self._sizes = {node: size for node, size in self._sizes.items() if node in outer}
        self._first = self._next_first([node for node in near_first if node in paces])
        return self.asked_for != before

    def _next_first(self, near_first: list[int]) -> frozenset[int]:
        """The nearest of which nothing is known, as many as there are bytes for in one go, at least one."""
        if self._budget is None:
            return frozenset()
        unknown = [node for node in near_first if node not in self._sizes]
        most = int(FIRST_SECONDS * self._budget / self._guess)
        return frozenset(unknown[: max(1, most)])

    def _affordable(self, near_first: list[int]) -> dict[int, int]:
        """From the farthest on: one pace slower, and again, as long as the budget asks for it; then without."""
        paces = dict.fromkeys(near_first, 0)
        if self._budget is None:
            return paces
        excess = self._cost(paces) + self._beyond - KEPT_SHARE * self._budget
        for pace in range(1, PACES):
            for node in reversed(near_first):
                if excess <= 0:
                    return paces
                excess -= self._size(node) * self._rate / (1 << pace)
                paces[node] = pace
        # The very nearest stays, or there would be nothing to look at.
        for node in reversed(near_first[1:]):
            if excess <= 0:
                return paces
            excess -= self._size(node) * self._rate / (1 << paces.pop(node))
        return paces

    def _cost(self, paces: Mapping[int, int]) -> float:
        return sum(self._size(node) * self._rate / (1 << pace) for node, pace in paces.items())

    def _size(self, node: int) -> float:
        return self._sizes.get(node, self._guess)

    def _distance(self, node: int, point: tuple[float, float]) -> float:
        left, bottom, right, top = self._nodes.rectangle(node)
        return math.hypot(
            max(left - point[0], 0.0, point[0] - right), max(bottom - point[1], 0.0, point[1] - top)
        )
