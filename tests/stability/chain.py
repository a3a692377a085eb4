"""Balls on a line, solved exactly: collisions in time order, in rational numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

Numbers = Sequence[float]


@dataclass
class Chain:
    """Balls from left to right; every number given is taken as the exact rational that it is."""

    place: list[Fraction]
    velocity: list[Fraction]
    radius: list[Fraction]
    mass: list[Fraction]
    collisions: int = 0

    @classmethod
    def of(cls, place: Numbers, velocity: Numbers, radius: Numbers, mass: Numbers) -> Chain:
        return cls(*([Fraction(value) for value in values] for values in (place, velocity, radius, mass)))

    def _meeting(self, left: int) -> Fraction | None:
        """Time until ball `left` and its neighbour touch."""
        right = left + 1
        approach = self.velocity[left] - self.velocity[right]
        if approach <= 0:
            return None
        gap = self.place[right] - self.place[left] - self.radius[left] - self.radius[right]
        return gap / approach

    def run(self, duration: float) -> None:
        """Elastic collisions one by one; ties from left to right."""
        remaining = Fraction(duration)
        while True:
            waits = [
                (wait, left)
                for left in range(len(self.place) - 1)
                if (wait := self._meeting(left)) is not None
            ]
            wait, left = min(waits, default=(remaining, -1))
            if wait >= remaining:
                break
            self._move(wait)
            remaining -= wait
            self._exchange(left, left + 1)
        self._move(remaining)

    def _move(self, time: Fraction) -> None:
        self.place = [x + v * time for x, v in zip(self.place, self.velocity, strict=True)]

    def _exchange(self, left: int, right: int) -> None:
        m, n = self.mass[left], self.mass[right]
        u, v = self.velocity[left], self.velocity[right]
        self.velocity[left] = (u * (m - n) + 2 * n * v) / (m + n)
        self.velocity[right] = (v * (n - m) + 2 * m * u) / (m + n)
        self.collisions += 1
