"""The state that is drawn: between the last two predicted ones, so that any frame rate looks smooth."""

from __future__ import annotations

from kuglice import World
from kuglice_client.render.moment import HashState, Moment, between

__all__ = ["interpolate"]


def interpolate(
    previous: World, current: World, alpha: float, hash_state: HashState, *, nodes: bool
) -> Moment:
    """alpha * current + (1 - alpha) * previous.

    `nodes`: with the quadtree's nodes, for the overlay that shows them.
    """
    return between(Moment.of(previous), Moment.of(current, hash_state, nodes=nodes), alpha)
