"""What is to be seen at one moment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, Self

import numpy as np
from numpy.typing import NDArray

from kuglice import World
from kuglice.blending import blend

__all__ = ["HashState", "Moment", "Verdict", "Window", "between"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]

Verdict = Literal["local", "equal", "different"]
"""Nobody to compare with; equal to the server's; different from it."""


@dataclass(frozen=True, slots=True)
class HashState:
    """A state hash, the tick that it is of, and what became of comparing it."""

    hash: int
    tick: int
    verdict: Verdict = "local"


@dataclass(frozen=True, slots=True)
class Window:
    """The part of a world that a picture shows: `rectangle` of `box`, both left, bottom, right, top in metres."""

    rectangle: tuple[float, float, float, float]
    box: tuple[float, float, float, float]
    walls: bool = True


@dataclass(frozen=True, slots=True)
class Moment:
    """Balls in id order: position and velocity (n, 2), radius (n,), id (n,); units of the scene."""

    position: Floats
    velocity: Floats
    radius: Floats
    id: Ids
    tick: int = 0
    time: float = 0.0
    """Seconds since the start of the scene; between two ticks, between their times."""
    fixed: NDArray[np.bool_] | None = None
    """(n,) which balls are pegs."""
    players: Mapping[int, int] = field(default_factory=dict)
    """Ball id -> client whose ball it is."""
    hash_state: HashState | None = None
    nodes: Floats | None = None
    """(k, 4) left, bottom, right, top of quadtree nodes."""
    silent: bool = False
    """Whether the server has told nothing for so long that what is shown is a guess."""
    window: Window | None = None
    """What the picture is a part of; None: it is the whole box."""

    @classmethod
    def of(cls, world: World, hash_state: HashState | None = None, *, nodes: bool = False) -> Self:
        """Copies of what a world shows now."""
        return cls(
            position=world.position,
            velocity=world.velocity,
            radius=world.radius,
            id=world.id,
            tick=world.tick,
            time=world.time,
            fixed=np.isinf(world.mass),
            players={ball: client for client, ball in world.players if ball is not None},
            hash_state=hash_state,
            nodes=world.nodes() if nodes else None,
        )


def between(previous: Moment, current: Moment, alpha: float) -> Moment:
    """The moment alpha * current + (1 - alpha) * previous, alpha within 0 and 1.

    A ball that is new is drawn where it is now, one that is gone is not drawn. The rest is the current
    moment's.
    """
    return replace(
        current,
        position=blend(previous.id, previous.position, current.id, current.position, alpha),
        time=alpha * current.time + (1 - alpha) * previous.time,
    )
