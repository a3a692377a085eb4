"""Regression: the server copied whatever came under the input key of one who plays, before it looked at the size.

Zenoh puts together messages of up to 1 GiB, and the ring that holds those of a session counts messages and not bytes:
64 of 50 MB each, and a copy of every one that was read. Clients did the same with what was told or answered to them.
"""

from __future__ import annotations

import sys
import tracemalloc
from pathlib import Path

import pytest
import zenoh

from e2e.processes import Command, free_endpoint, until
from e2e.raw_client import RawClient
from kuglice.errors import ProtocolError
from kuglice.inputs import Kick
from kuglice.protocol import (
    MAX_WHOLE_BYTES,
    ClientInputs,
    Keys,
    Part,
    Refusal,
    Region,
    Status,
    Tick,
    client_configuration,
    close_session,
    decode,
    open_session,
    server_configuration,
)

WORLD = "small"
LARGE = 50_000_000


def peak_bytes(process: Command) -> int:
    """The most memory that it ever had."""
    (line,) = [
        line
        for line in Path(f"/proc/{process.pid}/status").read_text().splitlines()
        if line.startswith("VmHWM")
    ]
    return 1024 * int(line.split()[1])


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_large_messages_of_one_who_plays_take_no_memory_and_the_world_goes_on(server, endpoint):
    with RawClient(endpoint, WORLD, "vandal") as vandal:
        begin, peak = vandal.status(), peak_bytes(server)
        for _ in range(4):
            vandal.raw(bytes(LARGE))
            vandal.raw(bytes(MAX_WHOLE_BYTES))
        refused = vandal.answer(None)
        assert refused.client == vandal.number
        assert f"{MAX_WHOLE_BYTES} bytes, at most {ClientInputs.max_bytes} allowed" in refused.refused
        until(lambda: vandal.status().counters.get("malformed", 0) == 4, what="those that got in are counted")
        assert vandal.status().counters["bytes_in"] < LARGE, "what is larger is never put together"
        assert peak_bytes(server) - peak < LARGE
        until(lambda: vandal.status().tick > begin.tick + 20, what="the world goes on")
        vandal.send((1, vandal.status().tick, Kick(vx=1.0, vy=0.0)))
        assert vandal.answer(1).refused is None


def test_a_question_that_is_too_large_is_refused_in_words(server, endpoint):
    with RawClient(endpoint, WORLD, None) as asker:
        for key in (asker.keys.status, asker.keys.history):
            (reply,) = asker.session.get(key, payload=bytes(MAX_WHOLE_BYTES), timeout=30.0)
            assert f"{MAX_WHOLE_BYTES} bytes, at most" in decode(reply.err.payload, Refusal).reason


@pytest.mark.parametrize("kind", [ClientInputs, Tick, Part, Region, Status])
def test_nothing_is_copied_of_what_is_too_large(kind):
    payload = zenoh.ZBytes(bytes(kind.max_bytes + 1))
    tracemalloc.start()
    try:
        with pytest.raises(ProtocolError, match=f"{kind.max_bytes + 1} bytes, at most"):
            decode(payload, kind)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < kind.max_bytes // 2


@pytest.mark.parametrize("protocol", ["tcp", "tcp+udp"])
def test_the_largest_message_of_all_gets_through_and_a_larger_one_harms_no_other(protocol):
    endpoint = free_endpoint().replace("tcp", protocol)
    longest = Keys("w" * 32).input("n" * 32, "s" * 32)
    router = open_session(server_configuration(listen=[endpoint], connect=[]))
    here, there = (open_session(client_configuration([endpoint], timeout=30.0)) for _ in range(2))
    inbox = there.declare_subscriber(longest, zenoh.handlers.RingChannel(8))

    def put(size: int) -> None:
        here.put(longest, bytes(size), congestion_control=zenoh.CongestionControl.BLOCK)

    def takes_one() -> zenoh.Sample | None:
        put(0)
        return inbox.try_recv()

    until(takes_one, what="the way is known")
    sizes = []

    def all_came() -> bool:
        while (sample := inbox.try_recv()) is not None:
            sizes.append(len(sample.payload))
        return sizes[-1:] == [1]

    for size in (MAX_WHOLE_BYTES, 2 * MAX_WHOLE_BYTES, LARGE, MAX_WHOLE_BYTES, 1):
        put(size)
    until(all_came, what="the last one")
    assert [size for size in sizes if size] == [MAX_WHOLE_BYTES, MAX_WHOLE_BYTES, 1]
    for session in (here, there, router):
        close_session(session, [])
