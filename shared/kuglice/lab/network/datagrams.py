"""The UDP half of the proxy: one socket towards the target for each peer that sends."""

from __future__ import annotations

import asyncio
import socket
from collections import OrderedDict
from functools import partial

from kuglice.lab.network.way import Way

__all__ = ["Datagrams"]

REMEMBERED_PEERS = 256
LARGEST = 65_536

Address = tuple[str, int]


class Datagrams:
    """Relays between peers of the `listen` address and `target`, inside a running event loop. Raises OSError."""

    def __init__(self, listen: Address, target: Address, up: Way, down: Way) -> None:
        self._loop = asyncio.get_running_loop()
        self._target = target
        self._up, self._down = up, down
        self._peers: OrderedDict[Address, socket.socket] = OrderedDict()
        self._listening = _socket(listen[0])
        self._listening.bind(listen)
        self._loop.add_reader(self._listening, self._from_peers)

    def close(self) -> None:
        """Stop relaying."""
        for each in (self._listening, *self._peers.values()):
            self._loop.remove_reader(each)
            each.close()

    def _from_peers(self) -> None:
        data, peer = self._listening.recvfrom(LARGEST)
        far = self._peers.get(peer)
        if far is None:
            far = self._peers[peer] = _socket(self._target[0])
            far.connect(self._target)
            self._loop.add_reader(far, self._from_target, far, peer)
            self._forget()
        self._up.packet(data, partial(_send, far, None), protocol="udp", flow=peer)

    def _from_target(self, far: socket.socket, peer: Address) -> None:
        try:
            data = far.recv(LARGEST)
        except OSError:
            # Nobody listens there at present; datagrams are lost without a word.
            return
        self._down.packet(data, partial(_send, self._listening, peer), protocol="udp", flow=peer)

    def _forget(self) -> None:
        while len(self._peers) > REMEMBERED_PEERS:
            _, oldest = self._peers.popitem(last=False)
            self._loop.remove_reader(oldest)
            oldest.close()


def _socket(host: str) -> socket.socket:
    made = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_DGRAM)
    made.setblocking(False)
    return made


def _send(through: socket.socket, peer: Address | None, data: bytes) -> None:
    try:
        if peer is None:
            through.send(data)
        else:
            through.sendto(data, peer)
    except OSError:
        # As above, and closed meanwhile, and full: all of it is loss.
        return
