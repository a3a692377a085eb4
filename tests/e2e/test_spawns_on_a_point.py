"""The story of tests/server/test_spawns_on_a_point.py with a real server: it answers, and everybody stays equal."""

from __future__ import annotations

from e2e.processes import until
from e2e.raw_client import RawClient
from e2e.verdict import assert_all_equal
from kuglice.inputs import Attract, Spawn
from server.test_spawns_on_a_point import POINT, scene


def test_a_heap_of_spawns_is_refused_with_the_reason_and_the_world_goes_on(start, endpoint, tmp_path):
    scene(strength=20.0, softening=0.1, restitution=1.0).save(tmp_path / "small.toml")
    record = tmp_path / "run.kuglice"
    server = start("server", tmp_path / "small.toml", "--listen", endpoint, "--record", record, "--json")
    x, y = POINT
    with RawClient(endpoint, "small", "ana") as ana:
        until(lambda: ana.listen() and ana.tick > 10, what="some ticks")
        player = start("client", "--connect", endpoint, "--bot", "chaser", "--seconds", 3, "--json")
        ana.send((1, 0, Attract(x=x, y=y, strength=20.0)))
        sequence = 2
        while player.running:
            # The second of two in one tick has no room even if the first one has.
            spawns = [Spawn(x=x, y=y, radius=0.1, mass=1.0) for _ in range(8)]
            ana.send(*((sequence + n, 0, spawn) for n, spawn in enumerate(spawns)))
            assert ana.answer(sequence + 7).refused is not None
            sequence += 8
        reasons = [ack.refused for ack in ana.acks.values() if ack.refused is not None]
        assert any("no room" in reason for reason in reasons)
        assert ana.status().counters["left_out"] >= 8
        assert ana.status().balls < 60
    figures = player.figures()
    server.signal(2)
    assert server.figures()["ticks"] > 0
    assert_all_equal(record, [figures])
