"""What the protocol's README says of quality of service and of the intake's bounds is what server and client do."""

from __future__ import annotations

import re
import threading
import time

import pytest
import zenoh

import kuglice as kg
from e2e.processes import free_endpoint, until
from e2e.serving import serving
from kuglice.protocol import (
    ANY_EPOCH,
    ClientInputs,
    Keys,
    SnapshotRequest,
    client_configuration,
    close_session,
    encode,
    open_session,
    server_configuration,
)
from kuglice_client.link import Link
from kuglice_server import ServerSettings, intake, players
from kuglice_server.cadence import EARLIEST_SECONDS, Cadence
from kuglice_server.counters import Counters
from kuglice_server.description import Description
from kuglice_server.publish import Publisher
from kuglice_server.regions import RegionPublisher, choose_terms
from shared.protocol.readme import PROSE, table

WORLD = "small"
KEYS = Keys(WORLD)
QUALITY = {row[0].replace("{world}", WORLD): row[-1] for row in table("key", "what", "from", "to", "quality")}
REGION, INPUT = KEYS.region(0, []) + "/", KEYS.input("ada", "s1")


def told(key: str) -> list[str]:
    """What the README says of that key."""
    (row,) = [
        quality
        for written, quality in QUALITY.items()
        if key == written or (written.endswith("...") and key.startswith(f"kuglice/{WORLD}/region/"))
    ]
    return row.split(", ")


def seen(sample: zenoh.Sample) -> list[str]:
    """The same of what came, as far as it can be seen there."""
    found = [str(one).partition(".")[2] for one in (sample.priority, sample.congestion_control)]
    return found + (["express"] if sample.express else [])


@pytest.fixture
def session():
    """A server's, with nothing declared."""
    session = open_session(server_configuration(listen=[free_endpoint()], connect=[]))
    yield session
    close_session(session, [])


def test_what_a_server_tells_and_answers_comes_as_told():
    heard: dict[str, zenoh.Sample] = {}
    with serving(WORLD) as (endpoint, _):
        asker = open_session(client_configuration([endpoint], timeout=30.0))
        asker.declare_subscriber(f"kuglice/{WORLD}/**", lambda one: heard.setdefault(str(one.key_expr), one))
        wanted = {KEYS.tick, KEYS.snapshot, KEYS.holding}
        until(lambda: wanted < heard.keys(), what="one of each, and a region")
        for key in (KEYS.about, KEYS.view, KEYS.status, KEYS.history):
            asks = encode(SnapshotRequest(epoch=ANY_EPOCH, at=None)) if key == KEYS.history else None
            replies = asker.get(
                key, payload=asks, timeout=30.0, congestion_control=zenoh.CongestionControl.BLOCK
            )
            heard[key] = next(iter(replies)).ok
        close_session(asker, [])
    for key, sample in heard.items():
        assert seen(sample) == told(key)[1:], key


def test_scenes_are_told_without_groups_and_balls():
    assert "without groups; no bytes in the four of balls" in PROSE
    world = kg.World(kg.scenes.gas(n=10))
    settings = ServerSettings(world=WORLD)
    terms = choose_terms(world, rate=10.0)
    told = Description(WORLD, world, epoch=1, cadence=Cadence.of(settings, world), terms=terms)
    for scene in (told.about(tick=0).scene, told.view_about(tick=0, balls=10).scene):
        assert "groups" not in scene
        assert list(scene["balls"].values()) == [b""] * 4


def test_what_a_server_tells_is_as_reliable_as_told(session):
    world = kg.World(kg.scenes.gas(n=10))
    terms = choose_terms(world, rate=10.0)
    regions = RegionPublisher(
        session, KEYS, terms, epoch=1, world=world, every=6, counters=Counters(), teller=None
    )
    published = [
        *Publisher(session, KEYS, epoch=1, rate=60, counters=Counters()).declared,
        *regions.declared,
    ]
    assert len(published) > 3
    for publisher in published:
        reliability = told(str(publisher.key_expr))[0].replace("-", "_").upper()
        assert str(publisher.reliability) == f"Reliability.{reliability}", publisher.key_expr


def test_inputs_come_as_told():
    endpoint = free_endpoint()
    session = open_session(server_configuration(listen=[endpoint], connect=[]))
    heard = session.declare_subscriber(KEYS.inputs, zenoh.handlers.FifoChannel(10))
    link = Link((endpoint,), deadline=time.monotonic() + 30, stop=threading.Event())
    link.listen(KEYS)
    link.show("ada", "s1")
    message = ClientInputs(epoch=1, heard=0, inputs=[])

    def came() -> zenoh.Sample | None:
        # A put before the subscription has arrived there has no subscriber.
        link.send(message)
        return heard.try_recv()

    sample = until(came, what="an input")
    (quality,) = [quality for key, quality in QUALITY.items() if "/input/" in key]
    assert seen(sample) == quality.split(", ")[1:]
    assert quality.startswith("best-effort")
    assert link._input.reliability == zenoh.Reliability.BEST_EFFORT
    link.close(0.5)
    close_session(session, [heard])


def test_numbers_in_the_text_are_those_of_the_server():
    for text, value in {
        r"more than (\d+) s: refused": EARLIEST_SECONDS,
        r"more than (\d+): refused, and not taken": intake.SEQUENCE_JUMP,
        r"more than (\d+) messages or": intake.MESSAGES_PER_TICK,
        r"messages or (\d+) inputs": intake.INPUTS_PER_TICK,
        r"more than (\d+) answers": intake.ANSWERS_PER_TICK,
        r"more than (\d+) who wait to be let in": players.MAX_NAMES,
        r"waited for \((\d+) s by default\)": int(ServerSettings(world=WORLD).grace),
    }.items():
        assert re.findall(text, PROSE) == [str(value)], text
