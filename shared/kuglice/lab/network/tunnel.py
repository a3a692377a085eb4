"""A link of true IP packets between two network namespaces: a process with a TUN device in each.

Whatever a TCP or UDP stack does about delay, loss and reordering, it does for real. The namespaces have no
names and no other way out; they and the devices are gone when the process ends, however it ends.
"""

from __future__ import annotations

import asyncio
import os
from collections import Counter
from functools import partial

from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.line import Line
from kuglice.lab.network.orders import obey, say
from kuglice.lab.network.tun_device import open_in_new_namespace
from kuglice.lab.network.way import Way

__all__ = ["CLIENT_ADDRESS", "SERVER_ADDRESS", "run_tunnel"]

SERVER_ADDRESS, CLIENT_ADDRESS = "10.77.0.1", "10.77.0.2"
SHORTEST_PACKET, LARGEST_PACKET = 20, 65_536
PACKETS_AT_ONCE = 64
PROTOCOLS = {6: "tcp", 17: "udp"}


def run_tunnel(conditions: Conditions) -> None:
    """Say where the namespaces are, then carry packets until stdin ends. Raises NetworkError."""
    server, server_namespace = open_in_new_namespace("kuglice0", SERVER_ADDRESS)
    client, client_namespace = open_in_new_namespace("kuglice1", CLIENT_ADDRESS)
    counter: Counter[str] = Counter()
    lines = (Line(conditions, 0), Line(conditions, 1))

    async def carry() -> None:
        loop = asyncio.get_running_loop()
        up, down = Way("up", lines[0], counter), Way("down", lines[1], counter)
        loop.add_reader(client, _forward, client, server, up)
        loop.add_reader(server, _forward, server, client, down)
        paths = [f"/proc/{os.getpid()}/fd/{number}" for number in (server_namespace, client_namespace)]
        say(server_namespace=paths[0], client_namespace=paths[1])
        await obey(lines, counter, lambda one: one.begin(lines, loop.time()))

    asyncio.run(carry())


def _forward(source: int, sink: int, way: Way) -> None:
    for _ in range(PACKETS_AT_ONCE):
        try:
            packet = os.read(source, LARGEST_PACKET)
        except BlockingIOError:
            return
        # IPv6 looks for neighbours by itself; nobody here speaks it.
        if len(packet) < SHORTEST_PACKET or packet[0] >> 4 != 4:
            continue
        protocol = PROTOCOLS.get(packet[9], "other")
        way.packet(packet, partial(_write, sink), protocol=protocol, flow=_flow(packet))


def _flow(packet: bytes) -> bytes:
    """Protocol, addresses and ports."""
    ports = 4 * (packet[0] & 15)
    return packet[9:10] + packet[12:20] + packet[ports : ports + 4]


def _write(sink: int, packet: bytes) -> None:
    try:
        os.write(sink, packet)
    except BlockingIOError:
        # A full device drops packets, as a full router does.
        return
