"""The key space of one world: every key that a server or a client touches is made here."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from kuglice.errors import ProtocolError

__all__ = ["ANY_STATUS", "Keys", "check_name"]

ROOT = "kuglice"
ANY_STATUS = f"{ROOT}/*/status"
"""Asked by a client that was not told a world: whoever serves one answers."""

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,31}")


def check_name(what: str, name: str) -> str:
    """`name` as it is, if it can be one chunk of a key; raises ProtocolError otherwise."""
    if not NAME.fullmatch(name):
        raise ProtocolError(
            f"{what} {name[:64]!r}: must be 1 to 32 letters, digits, '-' or '_', a letter or digit first"
        )
    return name


@dataclass(frozen=True)
class Keys:
    """The keys of the world `world`. Raises ProtocolError if its name cannot be part of a key."""

    world: str

    def __post_init__(self) -> None:
        check_name("world", self.world)

    def _under(self, rest: str) -> str:
        return f"{ROOT}/{self.world}/{rest}"

    @property
    def about(self) -> str:
        """Query: scene, model, versions, limits."""
        return self._under("about")

    @property
    def tick(self) -> str:
        """Put at every tick: inputs, hash, acknowledgements."""
        return self._under("tick")

    @property
    def snapshot(self) -> str:
        """Put now and then: the full state, in parts."""
        return self._under("snapshot")

    @property
    def history(self) -> str:
        """Query: a range of ticks, or a snapshot."""
        return self._under("history")

    @property
    def status(self) -> str:
        """Query: rates, clients, lateness, what was refused."""
        return self._under("status")

    @property
    def view(self) -> str:
        """Query: what a view must know, of a size that does not grow with the balls."""
        return self._under("view")

    @property
    def holding(self) -> str:
        """Put now and then while somebody listens: who plays and what is held."""
        return self._under("holding")

    def region(self, pace: int, path: Sequence[int]) -> str:
        """Put while somebody listens: the balls of the quadtree's node at the end of `path`."""
        return self._under("/".join(["region", str(pace), *map(str, path)]))

    def regions(self, pace: int, path: Sequence[int]) -> str:
        """The nodes at and below the end of `path`."""
        return f"{self.region(pace, path)}/**"

    @property
    def all_regions(self) -> str:
        """Every region, at every pace."""
        return self._under("region/**")

    @staticmethod
    def node_of(key: str) -> tuple[int, ...]:
        """Path of the node that a region's key belongs to; raises ProtocolError."""
        digits = key.split("/")[4:]
        if not all(digit in ("0", "1", "2", "3") for digit in digits):
            raise ProtocolError(f"key {key[:64]!r}: must end with a path of 0, 1, 2 or 3")
        return tuple(map(int, digits))

    @property
    def inputs(self) -> str:
        """The input keys of all clients."""
        return self._under("input/*/*")

    @property
    def clients(self) -> str:
        """The liveliness tokens of all clients."""
        return self._under("client/*/*")

    def input(self, client: str, session: str) -> str:
        """Put by that session of the client of that name, and by nobody else; deleted when it leaves."""
        return self._under(f"input/{check_name('client', client)}/{check_name('session', session)}")

    def client(self, client: str, session: str) -> str:
        """Liveliness token of that session of the client of that name."""
        return self._under(f"client/{check_name('client', client)}/{check_name('session', session)}")

    @staticmethod
    def client_of(key: str) -> tuple[str, str]:
        """Name and session of the client that an input or liveliness key belongs to; raises ProtocolError."""
        _, client, session = ["", "", *key.split("/")][-3:]
        return check_name("client", client), check_name("session", session)

    @staticmethod
    def world_of(key: str) -> str:
        """Name of the world that a key belongs to; raises ProtocolError."""
        chunks = key.split("/")
        if len(chunks) < 3 or chunks[0] != ROOT:
            raise ProtocolError(f"key {key[:64]!r}: must begin with '{ROOT}/' and a world's name")
        return check_name("world", chunks[1])
