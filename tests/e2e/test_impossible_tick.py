"""Regression: an input within its bounds, with which a tick could not be made, ended the server.

Only what the step says of an input was caught, not what it says of a whole tick: a kick that the scene allows can ask
for more collisions with the walls than a tick may have.
"""

from __future__ import annotations

from e2e.processes import until
from e2e.raw_client import RawClient
from e2e.verdict import assert_all_equal
from kuglice import InputLimits, ModelPins
from kuglice.inputs import Kick
from server.small_arena import small_arena

FASTEST = 1e150


def test_an_input_that_makes_a_tick_impossible_is_left_out(start, join, endpoint, tmp_path, recording):
    limits = InputLimits(kick=FASTEST, max_balls=40, per_tick=4)
    scene = small_arena().model_copy(update={"limits": limits, "model": ModelPins(contacts="event")})
    scene.save(tmp_path / "small.toml")
    server = start(
        "server",
        tmp_path / "small.toml",
        "--listen",
        endpoint,
        "--record",
        recording.path,
        "--json",
    )
    with RawClient(endpoint, "small", "ana") as ana:
        until(lambda: ana.listen() and ana.tick > 10, what="some ticks")
        asked = ana.tick + 20
        ana.send((1, asked, Kick(vx=FASTEST, vy=0.0)))
        assert ana.answer(1).tick is None
        until(lambda: ana.status().counters.get("left_out") == 1, what="it is left out")
        player = join("--bot", "chaser")
        recording.go_on(60)
        figures = player.end()
    assert server.end()["ticks"] > asked + 20
    assert_all_equal(recording.path, [figures])
