"""What the protocol's README says is what the code does: keys, who may do what with them, fields, bytes."""

from __future__ import annotations

import re
import struct
from typing import Any

import numpy as np
import pytest

import kuglice as kg
from kuglice import _core, inputs, protocol
from kuglice.inputs import Attract
from kuglice.inputs.record import NUMBERS, RECORD
from kuglice.protocol import Keys, Message, Nodes, decode, encode
from kuglice.protocol.access import access_control
from kuglice.protocol.messages.envelope import CompactMessage
from kuglice.protocol.session import MAX_MESSAGE_BYTES
from shared.protocol.readme import PROSE, table, vectors

KEYS = Keys("w")
ROWS = table("key", "what", "from", "to", "quality")
MESSAGES = {
    kind.kind: kind
    for kind in vars(protocol).values()
    if isinstance(kind, type) and issubclass(kind, Message) and hasattr(kind, "kind")
}
REACHES = {"region/{pace}/{a}/{b}/...": "region/**", "{client}/{session}": "*/*"}
"""A key of the README, and how the server's side writes all that are like it."""


def made(key: str) -> str:
    """The key expression that a row is about."""
    for written, reached in REACHES.items():
        key = key.replace(written, reached)
    return key.replace("{world}", "w")


def test_every_key_is_told_and_no_other():
    names = [name for name, kind in vars(Keys).items() if isinstance(kind, property)]
    assert sorted(made(row[0]) for row in ROWS) == sorted(getattr(KEYS, name) for name in names)
    assert f"`{protocol.ANY_STATUS}`" in PROSE


def test_keys_of_one_node_and_one_session_look_as_told():
    told = {row[0].replace("{world}", "w") for row in ROWS}
    region = KEYS.region(4, [1, 3]).replace("/4/1/3", "/{pace}/{a}/{b}/...")
    sessions = {
        key.replace("/ada/s1", "/{client}/{session}")
        for key in (KEYS.input("ada", "s1"), KEYS.client("ada", "s1"))
    }
    assert {region} | sessions <= told
    assert f"`{{pace}}` is 0 to {protocol.PACES - 1}" in PROSE


def denied(*message: str) -> set[str]:
    """The keys of the rules about these messages."""
    rules = [rule for rule in access_control(KEYS)["rules"] if rule["messages"] == list(message)]
    assert rules
    return {(rule["flows"][0], key) for rule in rules for key in rule["key_exprs"]}


def test_who_tells_and_hears_is_what_access_control_allows():
    told = {made(key) for key, what, who, _, _ in ROWS if who == "server"}
    asked = {made(key) for key, what, _, to, _ in ROWS if what == "query" and to == "server"}
    said = {made(key) for key, what, who, to, _ in ROWS if who == "that session" and what.startswith("put")}
    shown = {made(key) for key, what, who, to, _ in ROWS if what == "liveliness token" and to == "server"}
    assert len(told) + len(asked) + len(said) + len(shown) == len(ROWS)
    assert denied("put", "delete") == {("ingress", key) for key in told} | {("egress", key) for key in said}
    assert denied("declare_queryable") == {("ingress", key) for key in asked}
    assert denied("query") == {("egress", key) for key in asked}
    assert denied("declare_subscriber") == {("ingress", key) for key in said}
    assert denied("liveliness_token") == {("egress", key) for key in shown}


def test_every_message_is_told_with_its_fields_and_bound():
    rows = {row[0]: row[1:] for row in table("kind", "letter", "where", "bytes at most", "fields")}
    assert rows.keys() == MESSAGES.keys()
    for name, (letter, _, bound, fields) in rows.items():
        kind = MESSAGES[name]
        assert letter.encode() == (kind.letter if issubclass(kind, CompactMessage) else b"")
        assert int(bound) == kind.max_bytes
        # `ticks` is how many the packed inputs are of: on the wire only.
        told = [field for field in fields.split(", ") if (name, field) != ("history", "ticks")]
        assert sorted(told) == sorted(kind.model_fields), name


def test_maps_within_messages_are_told_with_their_fields():
    scene = kg.scenes.arena(players=1, balls=4)
    world = kg.World(scene)
    world.step(
        inputs.pack(
            [inputs.join(scene, world, 1, 1), Attract(client=1, sequence=2, x=1.0, y=2.0, strength=3.0)]
        )
    )
    held = protocol.Holding.of(1, world)
    told = {row[0]: row[1] for row in table("within", "what it has")}
    assert told["both about: model"].split(", ") == list(world.model.to_message())
    assert told["view about: regions"].partition(": ")[0].split(", ") == list(
        protocol.RegionTerms.model_fields
    )
    assert told["status: clients"].partition(": ")[2].split(", ") == list(protocol.ClientStatus.model_fields)
    assert [len(row) for row in held.players] == [len(told["holding: players"].split(", "))]
    assert [len(row) for row in held.held] == [len(told["holding: held"].split(", "))]
    assert {kg.Thrust.model_fields["kind"].default, held.held[0][1]} == set(
        re.findall("`(.*?)`", told["holding: held"])
    )


def packed(regions: _core.Regions, node: int, balls: list[list[float]]) -> bytes:
    """Balls of id, x, y, vx, vy, as a server packs them."""
    row = {int(ball[0]): ball[1:] for ball in balls}
    numbers = np.array([row.get(number, [0.5, 0.5, 0.0, 0.0]) for number in range(max(row) + 1)])
    listed = kg.Balls(position=numbers[:, :2], velocity=numbers[:, 2:], radius=0.5, mass=1.0)
    world = kg.World(kg.Scene(box=(0, 0, 16, 16), walls=False, balls=listed))
    (found,), _ = world.regions(regions, [node])
    assert regions.unpack(found, 100)[0].tolist() == sorted(row)
    return found


@pytest.mark.parametrize(("before", "expression", "data"), vectors(), ids=lambda value: str(value)[:24])
def test_bytes_are_what_the_codec_writes_and_reads(before, expression, data):
    names: dict[str, Any] = {
        **vars(inputs),
        **vars(protocol),
        "Regions": _core.Regions,
        "packed": packed,
    }
    exec(before, names)
    message = eval(expression, names)
    assert encode(message).hex(" ") == data.hex(" ")
    assert decode(data, type(message)) == message


def test_vectors_are_of_each_compact_message():
    begun = {data[:1] for _, _, data in vectors()}
    assert {kind.letter for kind in MESSAGES.values() if issubclass(kind, CompactMessage)} < begun


def test_the_record_of_the_step_is_laid_out_as_told():
    sizes = {"u8": "B", "u32": "I", "u64": "Q", "6 f64": "6d"}
    at = 0
    for offset, kind, _ in table("offset", "type", "field"):
        assert int(offset) == at
        at += struct.calcsize("<" + sizes[kind])
    assert at == RECORD.size == _core.INPUT_BYTES
    assert f"{RECORD.size} bytes" in PROSE
    rows = table("kind", "name", "ball", "numbers")
    assert [row[1] for row in rows] == list(_core.INPUT_KINDS)
    for number, name, ball, numbers in rows:
        assert _core.INPUT_KINDS[int(number)] == name
        assert tuple(filter(None, numbers.split(", "))) == NUMBERS[name]
        names_one = {"kick": "may be", "remove": "yes"}
        assert ball == names_one.get(name, "no")


def test_numbers_in_the_text_are_those_of_the_code():
    for text, value in {
        r"`PROTOCOL_VERSION` is (\d+)": protocol.PROTOCOL_VERSION,
        r"carry (\d+) bytes of data each": protocol.PART_BYTES,
        r"has not passed them, up to (\d+);": protocol.MAX_TOLD_TICKS,
        r"all that are unacknowledged, at most (\d+),": protocol.MAX_INPUTS,
    }.items():
        assert re.findall(text, PROSE) == [str(value)], text
    assert MAX_MESSAGE_BYTES == (1 << 20) + (64 << 10)
    assert "beyond 1 MiB and 64 KiB, key and envelope included" in PROSE


def test_a_path_says_the_quarters_that_the_text_names():
    nodes = Nodes((0.0, 0.0, 4.0, 4.0), 1)
    corners = [nodes.rectangle(node)[:2] for node in range(4)]
    assert corners == [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (2.0, 2.0)]
    assert [nodes.path(node) for node in range(4)] == [(0,), (1,), (2,), (3,)]
    assert "0 left bottom, 1 right bottom, 2 left top, 3 right top" in PROSE


@pytest.mark.parametrize(("numbers", "size"), [(False, 1), (True, 2)])
def test_compressed_bytes_begin_with_how(numbers, size):
    data = bytes(range(64)) * 40 + b"tail"
    assert protocol.compress(b"ab", numbers=numbers)[0] == 0
    assert protocol.compress(data, numbers=numbers)[0] == size
    assert "`00` plain, `01` zlib, `02` zlib over" in PROSE
