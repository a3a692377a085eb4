"""Regression: whoever could reach the server could speak for it, and for everybody else.

Ticks of random epochs, put sixty times per second, had each client join anew once per message; one far ahead left
it a million million ticks behind. Status told everybody's session, and whoever deletes the input key of a session takes
its ball away.
"""

from __future__ import annotations

import random
import signal
import time

import pytest
import zenoh

import kuglice as kg
from e2e.processes import free_endpoint, until
from e2e.raw_client import RawClient
from e2e.serving import serving
from kuglice.protocol import Keys, Tick, client_configuration, close_session, encode, open_session
from kuglice_client import Client, ClientSettings

WORLD = "small"
KEYS = Keys(WORLD)


@pytest.fixture
def served():
    """An endpoint, and the server there, ticking."""
    with serving(WORLD) as served:
        yield served


@pytest.fixture
def stranger(served):
    session = open_session(client_configuration([served[0]], timeout=30.0))
    yield session
    close_session(session, [])


def forged(epoch: int, first: int) -> bytes:
    return encode(Tick(epoch=epoch, first=first, inputs=[b""], state_hash=None, acks=[]))


def test_nobody_but_the_server_hears_inputs_or_sees_sessions(served, stranger):
    heard: list[str] = []
    for key in (KEYS.inputs, f"kuglice/{WORLD}/**", "**"):
        stranger.declare_subscriber(key, lambda sample: heard.append(str(sample.key_expr)))
        stranger.liveliness().declare_subscriber(
            key, lambda sample: heard.append(str(sample.key_expr)), history=True
        )
    endpoint, _ = served
    with RawClient(endpoint, WORLD, "ana") as ana:
        ana.send((1, 1, kg.Kick(vx=1.0, vy=0.0)))
        ana.answer(1)
        listed = [
            str(reply.ok.key_expr)
            for reply in stranger.liveliness().get("kuglice/**", timeout=5.0)
            if reply.ok is not None
        ]
        assert ana.session_id not in repr(ana.status())
    assert any(key == KEYS.tick for key in heard), "it does listen"
    assert not [key for key in (*heard, *listed) if "/input/" in key or "/client/" in key]


def test_nobody_else_ends_a_session(served, stranger):
    endpoint, server = served
    with RawClient(endpoint, WORLD, "ana") as ana:
        for key in (KEYS.inputs, f"kuglice/{WORLD}/input/ana/*", "**"):
            stranger.delete(key, congestion_control=zenoh.CongestionControl.BLOCK)
        until(lambda: server.counters["foreign"] >= 3, what="they came, and were told from ana's own")
        assert not ana.status().clients["ana"].away
        ana.send((1, 1, kg.Kick(vx=1.0, vy=0.0)))
        assert ana.answer(1).refused is None


def test_what_the_server_says_is_taken_from_nobody_else(served, stranger):
    endpoint, server = served
    settings = ClientSettings(connect=(endpoint,), world=WORLD, name="ana", bot="orbiter", wait=60.0)
    with Client(settings) as client:
        for number in range(60):
            for key in (KEYS.tick, f"kuglice/{WORLD}/*", "**"):
                stranger.put(key, forged(random.getrandbits(36), number))
                stranger.put(key, forged(server.epoch, 2**40))
            client.run(seconds=0.01)
        deadline = time.monotonic() + 60
        while client.confirmed.tick < server.status().tick - 30 and time.monotonic() < deadline:
            client.run(seconds=0.1)
        assert client.replica.credibility.disbelieved == 0, "none of it was even heard"
        figures = client.summary()
    assert figures["agreed"]
    assert (figures["rejoins"], figures["malformed_messages"]) == (0, 0)
    assert client.replica.follower.behind < 1000


def test_what_gets_through_a_router_is_not_believed(served, start):
    """A router without rules, behind which a stranger speaks as the server."""
    endpoint, server = served
    behind = free_endpoint()
    router = start("router", "--connect", endpoint, "--listen", behind)
    until(lambda: "router from" in router.err, what="the router")
    stranger = open_session(client_configuration([behind], timeout=30.0))
    settings = ClientSettings(connect=(behind,), world=WORLD, name="ana", bot="orbiter", wait=60.0)
    with Client(settings) as client:

        def doubts() -> bool:
            stranger.put(KEYS.tick, forged(random.getrandbits(36), 5))
            stranger.put(KEYS.tick, forged(server.epoch, 2**40))
            client.run(seconds=0.02)
            return client.replica.credibility.disbelieved >= 40

        first = client.replica
        until(doubts, what="forged ticks at the client")
        until(lambda: client.run(seconds=0.1) or client.replica.stream.silent(time.monotonic()) is False)
        assert client.replica is first, "it has not joined anew"
        assert client.replica.follower.behind < 1000
        assert client.summary()["rejoins"] == 0
    close_session(stranger, [])
    router.signal(signal.SIGINT)
    assert router.wait() == 0
