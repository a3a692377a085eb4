"""The story of tests/server/test_spawns_on_a_point.py with a real server: it answers, and everybody stays equal."""

from __future__ import annotations

from e2e.processes import until
from e2e.raw_client import RawClient
from e2e.verdict import assert_all_equal
from kuglice.inputs import Attract, Spawn
from server.test_spawns_on_a_point import POINT, scene

HEAP = 8
"""Spawns at once."""
HEAPS = 20


def test_a_heap_of_spawns_is_refused_with_the_reason_and_the_world_goes_on(
    start, join, endpoint, recording, tmp_path
):
    scene(strength=20.0, softening=0.1, restitution=1.0).save(tmp_path / "small.toml")
    server = start(
        *("server", tmp_path / "small.toml", "--listen", endpoint),
        *("--record", recording.path, "--json"),
    )
    x, y = POINT
    with RawClient(endpoint, "small", "ana") as ana:
        until(lambda: ana.listen() and ana.tick > 10, what="some ticks")
        player = join("--bot", "chaser")
        ana.send((1, 0, Attract(x=x, y=y, strength=20.0)))
        sequence, reached = 2, len(recording)
        while sequence < HEAPS * HEAP or len(recording) < reached + 120:
            # The second of two in one tick has no room even if the first one has.
            spawns = [Spawn(x=x, y=y, radius=0.1, mass=1.0) for _ in range(HEAP)]
            ana.send(*((sequence + n, 0, spawn) for n, spawn in enumerate(spawns)))
            assert ana.answer(sequence + HEAP - 1).refused is not None
            sequence += HEAP
        reasons = [ack.refused for ack in ana.acks.values() if ack.refused is not None]
        assert any("no room" in reason for reason in reasons)
        assert ana.status().counters["left_out"] >= 8
        assert ana.status().balls < 60
        figures = player.end()
    assert server.end()["ticks"] > 0
    assert_all_equal(recording.path, [figures])
