"""The state that is drawn: between the last two predicted ones, so that any frame rate looks smooth."""

from __future__ import annotations

import numpy as np

from kuglice import World
from kuglice_client.render.moment import HashState, Moment, between

__all__ = ["interpolate"]


def interpolate(
    previous: World, current: World, alpha: float, hash_state: HashState, *, nodes: bool
) -> Moment:
    """alpha * current + (1 - alpha) * previous.

    `nodes`: with the quadtree's nodes, for the overlay that shows them.
    """
    now = Moment(
        position=current.position,
        velocity=current.velocity,
        radius=current.radius,
        id=current.id,
        tick=current.tick,
        time=current.time,
        fixed=np.isinf(current.mass),
        players={ball: client for client, ball in current.players if ball is not None},
        hash_state=hash_state,
        nodes=current.nodes() if nodes else None,
    )
    before = Moment(
        position=previous.position,
        velocity=previous.velocity,
        radius=previous.radius,
        id=previous.id,
        tick=previous.tick,
        time=previous.time,
    )
    return between(before, now, alpha)
