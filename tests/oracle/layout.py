"""Where the balls of a test start: at random, apart from each other and from the walls."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oracle.hard_discs import Oracle

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Start:
    """A world at time 0: what both the oracle and the core are given."""

    box: tuple[float, float, float, float]
    position: Floats
    velocity: Floats
    radius: Floats
    mass: Floats
    gravity: tuple[float, float] = (0.0, 0.0)
    restitution: float = 1.0
    walls: bool = True

    @property
    def moving(self) -> int:
        """Balls that are not pegs."""
        return int(np.isfinite(self.mass).sum())

    def oracle(self, bits: int) -> Oracle:
        """Ready to run from here."""
        return Oracle(
            self.box if self.walls else None,
            self.position,
            self.velocity,
            self.radius,
            self.mass,
            gravity=self.gravity,
            restitution=self.restitution,
            bits=bits,
        )


def square_box(radius: Floats, packing: float) -> tuple[float, float, float, float]:
    """A square of which the discs cover the share `packing`."""
    side = float(np.sqrt(np.pi * (radius**2).sum() / packing))
    return (0.0, 0.0, side, side)


def spread(random: np.random.Generator, radius: Floats, box: tuple[float, float, float, float]) -> Floats:
    """(n, 2) positions without an overlap: thrown at random, then pushed apart until nothing touches."""
    low = np.array(box[:2]) + 1.01 * radius[:, None]
    high = np.array(box[2:]) - 1.01 * radius[:, None]
    reach = 1.01 * (radius[:, None] + radius[None, :])
    position = random.uniform(low, high)
    for _ in range(100_000):
        apart = position[:, None, :] - position[None, :, :]
        distance = np.hypot(apart[..., 0], apart[..., 1])
        np.fill_diagonal(distance, np.inf)
        inside = np.clip(1.0001 * reach - distance, 0, None)
        if not inside.any() or (distance > reach).all():
            return position
        position = np.clip(position + (apart * (0.5 * inside / distance)[..., None]).sum(axis=1), low, high)
    raise ValueError(f"found no place for {len(radius)} balls without overlap in the box {box}")


def gas(
    seed: int,
    count: int,
    packing: float,
    *,
    unequal: bool = False,
    pegs: int = 0,
    gravity: tuple[float, float] = (0.0, 0.0),
    restitution: float = 1.0,
) -> Start:
    """Speeds of order 1 and radii 1; unequal: radii 0.5 to 1.5, masses 0.2 to 5, independent."""
    random = np.random.default_rng(seed)
    radius = random.uniform(0.5, 1.5, count) if unequal else np.ones(count)
    mass = np.exp(random.uniform(np.log(0.2), np.log(5.0), count)) if unequal else np.ones(count)
    velocity = random.normal(size=(count, 2)) / np.sqrt(mass)[:, None]
    mass[:pegs] = np.inf
    velocity[:pegs] = 0.0
    box = square_box(radius, packing)
    return Start(box, spread(random, radius, box), velocity, radius, mass, gravity, restitution)


def settled(start: Start, hits_per_disc: float) -> Start:
    """The same world after that many collisions per moving disc: layout forgotten, numbers rounded to f64."""
    oracle = start.oracle(bits=53)
    time = 0.0
    while 2 * oracle.collisions < hits_per_disc * start.moving:
        time += 0.25
        oracle.run_to(time)
    return replace(start, position=oracle.position.astype(float), velocity=oracle.velocity.astype(float))
