"""A world put together from regions, each of which was told at a tick of its own.

A region tells all its balls, and the newest tick wins. A ball that its region does not list any more may have gone
over to another one, which tells it sooner or later: it stays if it is thought to be in a followed region whose last
news is older, else it goes.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from kuglice import BallStates, World
from kuglice_client.view.told import Floats, Ids, Node, Told

__all__ = ["Compare", "Mosaic"]

Compare = Callable[[Ids, Floats, Floats], None]


class Mosaic:
    """`owner`: (n,) the node that each ball of `world` is thought to be in. `news`: tick at which a node was told."""

    def __init__(self, world: World, owner: Node, news: dict[int, int]) -> None:
        self.world = world
        self._owner = owner
        self._news = news

    @classmethod
    def of(cls, world: World) -> Mosaic:
        """Of a world without balls, of which nothing was told."""
        return cls(world, np.empty(0, np.uint32), {})

    def clone(self) -> Mosaic:
        """Another one, that is equal."""
        return Mosaic(self.world.clone(), self._owner.copy(), dict(self._news))

    def copy_from(self, other: Mosaic) -> None:
        """Become equal to the other."""
        self.world.copy_from(other.world)
        self._owner, self._news = other._owner.copy(), dict(other._news)

    def keep_only(self, nodes: Collection[int]) -> None:
        """Forget the balls of all other nodes."""
        if not len(self._owner):
            return
        here = np.isin(self._owner, np.fromiter(nodes, np.uint32, len(nodes)))
        if not here.all():
            self.world.replace(self.world.id[~here], BallStates.none())
            self._owner = self._owner[here]

    def put_right(
        self,
        regions: Sequence[Told],
        fresh: Collection[int],
        *,
        followed: Collection[int],
        node_of: Callable[[Floats], Node],
        compare: Compare,
    ) -> None:
        """Take in what was told of this very tick; what `fresh` nodes tell is compared with what was thought."""
        owner, ids, position, velocity, radius, mass = _merged(regions)
        nodes = np.array([one.node for one in regions], np.uint32)
        self._news.update(dict.fromkeys(nodes.tolist(), self.world.tick))
        before_id, before = self.world.id, self.world.position
        rows = np.searchsorted(before_id, ids)
        known = rows < len(before_id)
        known[known] = before_id[rows[known]] == ids[known]
        compared = known & np.isin(owner, np.array(sorted(fresh), np.uint32))
        if compared.any():
            off = np.hypot(*(before[rows[compared]] - position[compared]).T) / radius[compared]
            compare(ids[compared], position[compared], off)
        stays = self._stays(before, nodes, followed, node_of)
        stays[rows[known]] = True
        self.world.replace(before_id[~stays], BallStates(ids, position, velocity, radius, mass))
        now_id = self.world.id
        owners = np.empty(len(now_id), np.uint32)
        owners[np.searchsorted(now_id, before_id[stays])] = self._owner[stays]
        owners[np.searchsorted(now_id, ids)] = owner
        self._owner = owners

    def _stays(
        self, position: Floats, told: Node, followed: Collection[int], node_of: Callable[[Floats], Node]
    ) -> NDArray[np.bool_]:
        """Which balls stay although a region that was told of does not list them; those change hands."""
        stays = np.ones(len(position), np.bool_)
        missing = np.flatnonzero(np.isin(self._owner, told))
        if len(missing):
            there = node_of(position[missing])
            tick = self.world.tick
            awaited = [self._news.get(int(node), -1) < tick and int(node) in followed for node in there]
            stays[missing] = awaited
            self._owner[missing[stays[missing]]] = there[stays[missing]]
        return stays


def _merged(regions: Sequence[Told]) -> tuple[Node, Ids, Floats, Floats, Floats, Floats]:
    """Node, id, position, velocity, radius and mass of all balls of the regions, by id."""
    ids = np.concatenate([told.id for told in regions])
    owner = np.repeat(
        np.array([told.node for told in regions], np.uint32), [len(told.id) for told in regions]
    )
    order = np.argsort(ids, kind="stable")
    # A ball is in one node; should two claim it, one is as good as the other.
    order = order[np.concatenate([[True], np.diff(ids[order]) > 0])] if len(ids) else order
    position, velocity, radius, mass = (
        np.concatenate([getattr(told, name) for told in regions])[order]
        for name in ("position", "velocity", "radius", "mass")
    )
    return owner[order], ids[order], position, velocity, radius, mass
