"""Messages that no server would send are refused before they are used, each with a reason."""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from kuglice.errors import ProtocolError
from kuglice.protocol import Keys, Nodes, Refusal, Region, ViewAbout, encode
from kuglice_client.view.hearing import Hearing
from kuglice_server.regions import choose_terms

KEYS = Keys("w")
WORLD = kg.World(kg.scenes.gas(n=1000))
TERMS = choose_terms(WORLD, rate=10.0)
NODES = Nodes(WORLD.scene.box, TERMS.depth)
PACKED, _ = WORLD.regions(TERMS.packer(WORLD.scene.box), range(NODES.count))


@pytest.fixture
def hearing() -> Hearing:
    about = ViewAbout(
        epoch=7,
        world="w",
        version="0",
        step_version=1,
        scene={},
        model={},
        rate=60.0,
        tick=600,
        balls=1000,
        reference_speed=1.0,
        regions=TERMS,
    )
    return Hearing(about, NODES, now=100.0)


def message(**changes) -> bytes:
    return encode(Region(**({"epoch": 7, "tick": 606, "node": 6, "balls": PACKED[6]} | changes)))


def key(node: int = 6, pace: int = 0) -> str:
    return KEYS.region(pace, NODES.path(node))


def test_a_region_is_heard(hearing):
    told = hearing.region(key(pace=3), message(), now=100.1)
    here = hearing.packer.node(WORLD.position) == 6
    assert (told.tick, told.node) == (606, 6)
    assert (told.id == WORLD.id[here]).all()
    assert np.abs(told.position - WORLD.position[here]).max() <= TERMS.position_quantum / 2


def test_of_another_run_nothing_is_heard(hearing):
    assert hearing.region(key(), message(epoch=8, balls=b"junk"), now=100.1) is None


@pytest.mark.parametrize(
    ("where", "data", "words"),
    [
        (key(), b"", "not msgpack"),
        (key(), b"\x00" * 2_000_000, "at most 1048576 allowed"),
        (key(), encode(Refusal(epoch=7, reason="no")), "expected 'region'"),
        (key(5), message(), "region 6 of 16 under the key"),
        ("kuglice/w/region/0/1/2/3", message(), "region 6 of 16 under the key"),
        (key(), message(node=6000), "region 6000 of 16"),
        (key(), message(balls=b""), "region: 1 more bytes wanted"),
        (key(), message(balls=b"\xff\xff\xff\x7f"), "balls, at most 131072"),
        (key(), message(balls=PACKED[6][:-1]), "region: "),
        (key(), message(balls=PACKED[6] + b"x"), "1 bytes too many"),
        (key(), message(balls=PACKED[9]), "region 6: ball .* outside of"),
        (key(), message(tick=2**61), "can have been by now"),
    ],
)
def test_what_cannot_be_is_refused(hearing, where, data, words):
    with pytest.raises(ProtocolError, match=words):
        hearing.region(where, data, now=100.1)


def test_later_a_later_tick_can_be(hearing):
    with pytest.raises(ProtocolError, match="tick 4002: at most"):
        hearing.region(key(), message(tick=4002), now=100.1)
    assert hearing.region(key(), message(tick=4002), now=160.0).tick == 4002
