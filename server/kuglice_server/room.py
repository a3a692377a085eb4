"""Where discs are hard, a ball needs a place of its own to appear in.

`event` keeps discs from overlapping, and has no answer to those that overlap from the start but collision after
collision. Clients spawn into a world that has moved on since they looked, and several at once, so the place is looked
at when the inputs act.
"""

from __future__ import annotations

import numpy as np

from kuglice import World
from kuglice.inputs import Input, Join, Remove, Spawn

__all__ = ["without_room"]

ROUNDING = 1e-9
"""Depth, in radii of the new ball, that is taken for touching."""


def without_room(world: World, authored: list[Input], inputs: list[Input]) -> list[tuple[Spawn, str]]:
    """The spawns among `inputs` for which there is no room, and why; none where discs are soft.

    `inputs` are in order of client and sequence, in which they act: the first to come stays. `authored` are the
    server's own, which go first.
    """
    spawns = [one for one in inputs if isinstance(one, Spawn)]
    if not spawns or world.model.contacts != "event":
        return []
    gone = [one.ball for one in authored if isinstance(one, Remove)]
    kept = ~np.isin(world.id, gone)
    names = [f"ball {ball}" for ball in world.id[kept].tolist()]
    discs = [*np.column_stack([world.position, world.radius])[kept].tolist()]
    for one in authored:
        if isinstance(one, Join) and one.radius > 0:
            names.append(f"the ball of client {one.client}")
            discs.append([one.x, one.y, one.radius])
    refused = []
    for spawn in spawns:
        deepest, where = _deepest(spawn, np.array(discs).reshape(-1, 3))
        if deepest > ROUNDING * spawn.radius:
            reason = (
                f"spawn {spawn.sequence} of client {spawn.client}: no room, {deepest:.6g} deep in {names[where]}, "
                "at most 0 allowed with contacts 'event'"
            )
            refused.append((spawn, reason))
        else:
            names.append(f"spawn {spawn.sequence} of client {spawn.client}")
            discs.append([spawn.x, spawn.y, spawn.radius])
    return refused


def _deepest(spawn: Spawn, discs: np.ndarray) -> tuple[float, int]:
    """How deep it would be in the nearest disc, and which one that is."""
    if not len(discs):
        return -np.inf, 0
    depths = spawn.radius + discs[:, 2] - np.hypot(discs[:, 0] - spawn.x, discs[:, 1] - spawn.y)
    where = int(depths.argmax())
    return float(depths[where]), where
