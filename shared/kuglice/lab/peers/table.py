"""All peers by name. Each is imported when it is asked for, so that one may be missing."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module

from kuglice.errors import MissingExtraError
from kuglice.lab.running import CannotRunError, Running
from kuglice.scene import Scene

__all__ = ["PEERS", "Peer"]


@dataclass(frozen=True)
class Peer:
    """An engine with its settings."""

    name: str
    module: str
    kind: str
    settings: tuple[tuple[str, int], ...] = ()

    def __call__(self, scene: Scene) -> Running:
        """The scene in this engine. Raises CannotRunError with the reason."""
        try:
            make = getattr(import_module(f"kuglice.lab.peers.{self.module}"), self.kind)
        except MissingExtraError as error:
            raise CannotRunError(str(error)) from error
        made: Running = make(scene, **dict(self.settings))
        return made


PEERS: dict[str, Peer] = {
    peer.name: peer
    for peer in (
        Peer("pymunk", "pymunk", "Pymunk"),
        Peer("pymunk, 30 iterations", "pymunk", "Pymunk", (("iterations", 30),)),
        Peer("rapier2d", "rapier", "Rapier"),
        Peer("numpy + cKDTree", "ckdtree", "KDTree"),
        Peer("numba grid", "numba_grid", "NumbaGrid"),
    )
}
