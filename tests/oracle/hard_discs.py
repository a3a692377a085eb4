"""The oracle: hard discs in a box, event by event, in as many bits as one asks for.

Slow and plain on purpose. No grid, no tree, no queue, no tick; nothing is shared with the core. Between
hits a ball flies on a parabola. Whenever its path changes, the ball looks at every wall and every other
ball for its next hit; the earliest of all balls' next hits happens next.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import gmpy2  # type: ignore[import-untyped]
import numpy as np
from gmpy2 import mpfr, sqrt
from numpy.typing import NDArray

from oracle.contact_time import time_to_pair, time_to_pair_on_parabola, time_to_wall

Numbers = Sequence[Any] | NDArray[Any]
WALLS = ("left", "right", "bottom", "top")


class EndlessHitsError(RuntimeError):
    """So many hits that it must be a ball at rest or a collapse, endless hits of which this has no model."""


@dataclass(slots=True)
class Path:
    """Where a ball is from time `since` until its next hit."""

    since: mpfr
    x: mpfr
    y: mpfr
    vx: mpfr
    vy: mpfr
    ax: mpfr
    ay: mpfr

    def at(self, time: mpfr) -> Path:
        """The same path, its numbers taken at `time`."""
        t = time - self.since
        x = self.x + (self.vx + self.ax * t / 2) * t
        y = self.y + (self.vy + self.ay * t / 2) * t
        return Path(time, x, y, self.vx + self.ax * t, self.vy + self.ay * t, self.ax, self.ay)


@dataclass(frozen=True, slots=True)
class Hit:
    """Ball `ball` meets `other`: a wall's name or another ball's index."""

    time: mpfr
    ball: int
    other: str | int


class Oracle:
    """Hard discs, exact but for rounding to `bits` bits per operation (53: the precision of an f64).

    Shapes: position and velocity (n, 2), radius and mass (n,), gravity (2,). `box` is (left, bottom, right,
    top), None for an open plane. Infinite mass: a ball that never moves and feels no gravity. Raises
    ValueError if such a ball has a velocity, EndlessHitsError after `most_hits` hits (also at restitution
    0, where discs would stick).
    """

    def __init__(
        self,
        box: Sequence[float] | None,
        position: Numbers,
        velocity: Numbers,
        radius: Numbers,
        mass: Numbers,
        *,
        gravity: Sequence[float] = (0.0, 0.0),
        restitution: float = 1.0,
        bits: int = 256,
        most_hits: int = 1_000_000,
    ) -> None:
        self._context = gmpy2.context(precision=bits)
        self.collisions = 0
        self.wall_hits = 0
        self._most_hits = most_hits
        with self._context:
            self.time = mpfr(0)
            self._box = (
                None
                if box is None
                else dict(zip(("left", "bottom", "right", "top"), map(mpfr, box), strict=True))
            )
            self._restitution = mpfr(restitution)
            self._radius = [mpfr(r) for r in radius]
            self._mass = [mpfr(m) for m in mass]
            self._path = []
            for (x, y), (vx, vy), m in zip(position, velocity, self._mass, strict=True):
                fixed = gmpy2.is_infinite(m)
                if fixed and (vx != 0 or vy != 0):
                    raise ValueError(f"a ball of infinite mass has velocity ({vx}, {vy}); it must be (0, 0)")
                ax, ay = (0, 0) if fixed else gravity
                self._path.append(Path(self.time, *map(mpfr, (x, y, vx, vy, ax, ay))))
            self._next = [self._earliest(ball) for ball in range(len(self._path))]

    def run_to(self, time: Any) -> None:
        """Let everything happen up to and including `time`."""
        with self._context:
            end = mpfr(time)
            if end < self.time:
                raise ValueError(f"time {end} is before {self.time}, and the oracle only runs forwards")
            while (hit := self._soonest()) is not None and hit.time <= end:
                self._happen(hit)
            self.time = end

    @property
    def position(self) -> NDArray[np.object_]:
        """(n, 2), in full precision; `.astype(float)` for numbers to plot or compare."""
        with self._context:
            return np.array([(p.x, p.y) for p in self._now()], dtype=object).reshape(-1, 2)

    @property
    def velocity(self) -> NDArray[np.object_]:
        """(n, 2), in full precision."""
        with self._context:
            return np.array([(p.vx, p.vy) for p in self._now()], dtype=object).reshape(-1, 2)

    @property
    def energy(self) -> mpfr:
        """Kinetic and potential, fixed balls left out."""
        with self._context:
            return sum(
                (
                    m * ((p.vx * p.vx + p.vy * p.vy) / 2 - p.ax * p.x - p.ay * p.y)
                    for p, m in zip(self._now(), self._mass, strict=True)
                    if not gmpy2.is_infinite(m)
                ),
                start=mpfr(0),
            )

    @property
    def momentum(self) -> tuple[mpfr, mpfr]:
        """Sum of m v, fixed balls left out."""
        with self._context:
            moving = [
                (p, m) for p, m in zip(self._now(), self._mass, strict=True) if not gmpy2.is_infinite(m)
            ]
            return sum((m * p.vx for p, m in moving), start=mpfr(0)), sum(
                (m * p.vy for p, m in moving), start=mpfr(0)
            )

    def look_again(self) -> None:
        """Forget every predicted hit and predict all of them anew: changes nothing, and a test says so."""
        with self._context:
            self._next = [self._earliest(ball) for ball in range(len(self._path))]

    def _now(self) -> list[Path]:
        return [path.at(self.time) for path in self._path]

    def _soonest(self) -> Hit | None:
        return min((hit for hit in self._next if hit is not None), key=lambda hit: hit.time, default=None)

    def _earliest(self, ball: int) -> Hit | None:
        """The next hit of one ball, if nothing else happens: every wall and every other ball is looked at."""
        return min(self._hits(ball), key=lambda hit: hit.time, default=None)

    def _hits(self, ball: int) -> Iterator[Hit]:
        me = self._path[ball].at(self.time)
        fixed = gmpy2.is_infinite(self._mass[ball])
        if self._box is not None and not fixed:
            for wall in WALLS:
                wait = time_to_wall(*self._towards(wall, me, self._radius[ball]))
                if wait is not None:
                    yield Hit(self.time + wait, ball, wall)
        for other, path in enumerate(self._path):
            if other == ball or (fixed and gmpy2.is_infinite(self._mass[other])):
                continue
            you = path.at(self.time)
            reach = self._radius[ball] + self._radius[other]
            if me.ax == you.ax and me.ay == you.ay:
                wait = time_to_pair(you.x - me.x, you.y - me.y, you.vx - me.vx, you.vy - me.vy, reach)
            else:
                wait = time_to_pair_on_parabola(
                    (you.x - me.x, you.y - me.y),
                    (you.vx - me.vx, you.vy - me.vy),
                    (you.ax - me.ax, you.ay - me.ay),
                    reach,
                )
            if wait is not None:
                yield Hit(self.time + wait, ball, other)

    def _towards(self, wall: str, path: Path, radius: mpfr) -> tuple[mpfr, mpfr, mpfr]:
        """Gap to a wall, speed and acceleration away from it."""
        assert self._box is not None
        if wall in ("left", "right"):
            place, speed, acceleration = path.x, path.vx, path.ax
        else:
            place, speed, acceleration = path.y, path.vy, path.ay
        if wall in ("left", "bottom"):
            return place - radius - self._box[wall], speed, acceleration
        return self._box[wall] - radius - place, -speed, -acceleration

    def _happen(self, hit: Hit) -> None:
        if self.collisions + self.wall_hits >= self._most_hits:
            raise EndlessHitsError(
                f"more than {self._most_hits} hits: ball {hit.ball} and {hit.other} at time {float(hit.time)}"
            )
        self.time = hit.time
        changed = (
            self._bounce(hit.ball, hit.other)
            if isinstance(hit.other, str)
            else self._collide(hit.ball, hit.other)
        )
        for ball, planned in enumerate(self._next):
            if ball in changed or (planned is not None and planned.other in changed):
                self._next[ball] = self._earliest(ball)

    def _bounce(self, ball: int, wall: str) -> set[int]:
        path = self._path[ball].at(self.time)
        if wall in ("left", "right"):
            path.vx = -self._restitution * path.vx
        else:
            path.vy = -self._restitution * path.vy
        self._path[ball] = path
        self.wall_hits += 1
        return {ball}

    def _collide(self, first: int, second: int) -> set[int]:
        """Equal and opposite impulses along the line of centres, their size set by e."""
        one, two = self._path[first].at(self.time), self._path[second].at(self.time)
        dx, dy = two.x - one.x, two.y - one.y
        distance = sqrt(dx * dx + dy * dy)
        nx, ny = dx / distance, dy / distance
        approach = (one.vx - two.vx) * nx + (one.vy - two.vy) * ny
        give_one, give_two = 1 / self._mass[first], 1 / self._mass[second]
        impulse = (1 + self._restitution) * approach / (give_one + give_two)
        one.vx -= impulse * give_one * nx
        one.vy -= impulse * give_one * ny
        two.vx += impulse * give_two * nx
        two.vy += impulse * give_two * ny
        self._path[first], self._path[second] = one, two
        self.collisions += 1
        return {first, second}
