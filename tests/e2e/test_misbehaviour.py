"""A server does not die of a message, and answers what can be answered."""

from __future__ import annotations

import os

import zenoh

from e2e.processes import until
from e2e.raw_client import RawClient
from e2e.verdict import assert_all_equal
from kuglice.inputs import Kick, Leave, Thrust
from kuglice.protocol import Refusal, SnapshotRequest, TickRange, decode, encode

WORLD = "small"


def test_garbage_on_every_key_is_counted_and_the_world_goes_on(server, join, endpoint, recording):
    with RawClient(endpoint, WORLD, "vandal") as vandal:
        begin = vandal.status()
        for payload in (b"", b"\xc1", b"\x93" * 5000, os.urandom(300), bytes(200_000)):
            vandal.raw(payload)
            vandal.raw(payload, name="nobody")
            for key in (vandal.keys.tick, vandal.keys.snapshot, vandal.keys.about, "kuglice/small/input/a/b"):
                vandal.put(key, payload)
        refused = vandal.answer(None)
        assert refused.client == vandal.number
        until(lambda: vandal.status().counters.get("malformed", 0) >= 5, what="malformed ones are counted")
        until(lambda: vandal.status().tick > begin.tick + 20, what="the world goes on")
        # A client beside it hears nothing of what the vandal says in the server's name.
        player = join("--bot", "chaser")
        for _ in range(20):
            vandal.put(vandal.keys.tick, os.urandom(100))
            vandal.put(vandal.keys.snapshot, os.urandom(100))
        recording.go_on(120)
        figures = player.end()
        assert figures["malformed_messages"] == 0
    server.end()
    assert_all_equal(recording.path, [figures])


def test_late_early_duplicate_forbidden_and_foreign_inputs_have_their_answers(server, endpoint):
    with RawClient(endpoint, WORLD, "ana") as ana:
        until(lambda: ana.listen() and ana.tick > 10, what="some ticks")
        ana.send((1, 2, Kick(vx=1.0, vy=0.0)))
        late = ana.answer(1)
        assert late.early < 0
        assert late.tick > 2
        ana.send((1, 2, Kick(vx=1.0, vy=0.0)), (2, ana.tick + 100_000, Thrust(x=1.0, y=0.0)))
        assert ana.answer(2).tick is None
        ana.send((3, ana.tick, Leave()))
        assert "only the server decides" in ana.answer(3).refused
        ana.send((4, ana.tick, Kick(vx=100.0, vy=0.0)))
        assert "at most 5" in ana.answer(4).refused
        ana.send((1, 1, Kick(vx=1.0, vy=0.0)), name="bob")
        ana.send((5, ana.tick, Kick(vx=1.0, vy=0.0)), epoch=1)
        ana.send((6, ana.tick + 5, Kick(vx=1.0, vy=0.0)))
        assert ana.answer(6).refused is None
        counters = ana.status().counters
        assert counters["accepted"] == 2
        assert counters["duplicate"] >= 1
        assert counters["refused"] == 3
        assert counters["other_epoch"] == 1
        assert 5 not in ana.acks
    server.signal(2)
    # A join, two kicks and a leave, and nothing else, were applied.
    assert server.figures()["inputs_applied"] <= 4


def test_questions_that_cannot_be_answered_are_refused_in_words(server, endpoint):
    with RawClient(endpoint, WORLD, None) as asker:
        epoch = until(lambda: (status := asker.status()).tick > 5 and status).epoch

        def ask(payload: bytes | None) -> str:
            (reply,) = asker.session.get(asker.keys.history, payload=payload, timeout=30.0)
            return decode(reply.err.payload.to_bytes(), Refusal).reason

        assert "needs a payload" in ask(None)
        assert "not msgpack" in ask(b"\xc1")
        assert "this server runs epoch" in ask(encode(SnapshotRequest(epoch=1, at=None)))
        assert "not kept, or not yet run" in ask(encode(TickRange(epoch=epoch, first=10**9, end=10**9 + 1)))
        assert asker.status().tick > 5
    server.signal(2)
    assert server.figures()["ticks"] > 5


def test_history_comes_in_parts_that_fit_into_a_batch(server, endpoint):
    with RawClient(endpoint, WORLD, None) as asker:
        epoch = until(lambda: (status := asker.status()).tick > 5 and status).epoch
        request = encode(SnapshotRequest(epoch=epoch, at=None))
        replies = list(
            asker.session.get(
                asker.keys.history, payload=request, timeout=30.0, consolidation=zenoh.ConsolidationMode.NONE
            )
        )
        assert replies
        assert all(len(reply.ok.payload) < 65_535 for reply in replies)
