"""A link between two ports of this machine, for TCP connections and UDP datagrams: runs everywhere, needs no root.

What it relays is payload, so it cannot lose a TCP segment: bytes that would have been in a lost one come later,
as they would after a retransmission. Datagrams are lost for good. A cut resets all connections and refuses new
ones until it is over.
"""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import os
from collections import Counter

from kuglice.errors import NetworkError
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.datagrams import Address, Datagrams
from kuglice.lab.network.interruption import Interruption
from kuglice.lab.network.line import Line
from kuglice.lab.network.way import Way

__all__ = ["Proxy"]

CHUNK_BYTES = 16_384
UNDER_WAY_BYTES = 1 << 20
"""Per connection and direction; a sender that is faster than the link has to wait, as it would for a window."""


class Proxy:
    """Relays from `listen` to `target`, each a host and a port, once started; use it inside an event loop."""

    def __init__(self, listen: Address, target: Address, conditions: Conditions) -> None:
        self.counter: Counter[str] = Counter()
        self.lines = (Line(conditions, 0), Line(conditions, 1))
        self._listen = listen
        self._target = target
        self._writers: set[asyncio.StreamWriter] = set()
        self._flows = itertools.count()

    async def start(self) -> None:
        """Listen. Raises NetworkError if the port is taken."""
        up, down = self.lines
        self._up, self._down = Way("up", up, self.counter), Way("down", down, self.counter)
        try:
            self._server = await asyncio.start_server(self._accept, *self._listen)
            self._datagrams = Datagrams(self._listen, self._target, self._up, self._down)
        except OSError as error:
            host, port = self._listen
            # asyncio tells the address again, and a name that nobody knows has a number that is none of the system's.
            reason = os.strerror(error.errno).lower() if error.errno and error.errno > 0 else error.strerror
            raise NetworkError(f"cannot listen on {host}:{port}: {reason}") from error

    def interrupt(self, interruption: Interruption) -> None:
        """Begin a cut or a stall of both directions now, whatever it says of when."""
        interruption.begin(self.lines, asyncio.get_running_loop().time())
        if interruption.kind == "cut":
            self.reset()

    def reset(self) -> None:
        """Break every TCP connection off."""
        for writer in self._writers:
            writer.transport.abort()

    def close(self) -> None:
        """Stop relaying."""
        self._server.close()
        self._datagrams.close()
        self.reset()

    async def _accept(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._writers.add(writer)
        far_writer = writer
        try:
            if self._up.is_cut:
                return
            far_reader, far_writer = await asyncio.open_connection(*self._target)
            self._writers.add(far_writer)
            # The line may have been cut while we connected, and be whole again.
            if self._up.is_cut or writer.is_closing():
                return
            await asyncio.gather(
                self._pump(reader, far_writer, self._up), self._pump(far_reader, writer, self._down)
            )
        except (OSError, asyncio.CancelledError):
            # One side broke off, or the proxy ends; the other side is to learn it in the same way.
            pass
        finally:
            for each in (writer, far_writer):
                each.transport.abort()
                self._writers.discard(each)

    async def _pump(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, way: Way) -> None:
        flow = next(self._flows)
        window = _Window(writer)
        while data := await reader.read(CHUNK_BYTES):
            window.under_way += len(data)
            way.stream(data, window.deliver, flow=flow)
            await window.room()
        way.stream(b"", window.deliver, flow=flow)
        await window.ended.wait()


class _Window:
    """Bytes under way to a writer, and a wait while they are too many."""

    def __init__(self, writer: asyncio.StreamWriter) -> None:
        self._writer = writer
        self._narrower = asyncio.Event()
        self.under_way = 0
        self.ended = asyncio.Event()

    def deliver(self, data: bytes) -> None:
        self.under_way -= len(data)
        self._narrower.set()
        if not data:
            self.ended.set()
        if self._writer.is_closing():
            return
        if data:
            self._writer.write(data)
        elif self._writer.can_write_eof():
            # Who has closed both ways meanwhile does not want to hear of an end.
            with contextlib.suppress(OSError):
                self._writer.write_eof()

    async def room(self) -> None:
        while self.under_way >= UNDER_WAY_BYTES:
            self._narrower.clear()
            await self._narrower.wait()
        await self._writer.drain()
