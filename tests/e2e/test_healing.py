"""A client that misses much, or goes wrong, comes back to the server's bits."""

from __future__ import annotations

import json
import struct
import time

from e2e.processes import until
from e2e.verdict import assert_all_equal
from kuglice import _core
from kuglice.inputs import Kick
from kuglice.protocol import MAX_TOLD_TICKS
from kuglice_client import Client, ClientSettings


def playing(client: Client, condition) -> None:
    def turned() -> bool:
        client.turn(time.monotonic())
        return condition()

    until(turned)


def test_a_long_silence_is_filled_from_history(server, endpoint, tmp_path):
    """Two seconds of messages in a row are more than the repeats of the stream can bridge."""
    lost = range(0)
    settings = ClientSettings(
        connect=(endpoint,), name="ana", bot="chaser", wait=60.0, lose=lambda tick: tick in lost
    )
    with Client(settings) as client:
        # From when it is there, which takes its time on a busy machine.
        lost = range(client.confirmed.tick + 30, client.confirmed.tick + 150)
        playing(client, lambda: client.confirmed.tick > lost.stop + 100)
        summary = client.summary()
    server.signal(2)
    server.figures()
    # The stream itself may lose some.
    assert len(lost) / 2 < summary["messages_thrown_away"] <= len(lost)
    # However many ticks the message after the silence repeats, these it cannot.
    assert summary["ticks_healed_by_history"] >= len(lost) - MAX_TOLD_TICKS
    assert summary["snapshots_taken"] == 0
    assert_all_equal(tmp_path / "run.kuglice", [summary])


def test_a_world_that_went_wrong_is_found_out_reported_and_replaced(server, endpoint, tmp_path, caplog):
    reports = tmp_path / "reports"
    with Client(ClientSettings(connect=(endpoint,), name="ana", wait=60.0, desync_reports=reports)) as client:
        playing(client, lambda: client.confirmed.tick > 30)
        # A bit that flips in memory, say: here, a kick that only this client's confirmed world gets.
        flipped, tick = client.confirmed.clone(), client.confirmed.tick
        playing(client, lambda: client.confirmed.tick > tick)
        flipped.step([Kick(ball=3, vx=1e-9, vy=0.0)])
        assert client.replica.follower.rerun(flipped, client.confirmed.tick)
        client.replica.follower.replace(flipped)
        wrong = client.replica.reconciler
        playing(client, lambda: wrong.hash_mismatches > 0)
        first_wrong = wrong.wrong_since
        assert first_wrong is not None
        playing(client, lambda: wrong.wrong_since is None)
        mismatches = wrong.hash_mismatches
        reached = client.confirmed.tick
        playing(client, lambda: client.confirmed.tick > reached + 60)
        summary = client.summary()
    assert wrong.hash_mismatches == mismatches, "once replaced, it stays equal"
    assert not summary["agreed"], "a session that was wrong once does not claim otherwise"
    assert summary["snapshots_taken"] >= 1
    assert wrong.desyncs
    assert wrong.desyncs[0].tick > tick
    assert wrong.desyncs[0].found_by == "hash"
    assert wrong.desyncs[0].tick == first_wrong
    assert any("ball 3:" in line for line in wrong.desyncs[0].balls)
    path = reports / f"desync-{first_wrong}.json"
    assert str(path) in caplog.text
    report = json.loads(path.read_text())
    assert (report["first_tick"], report["found_by"]) == (first_wrong, "hash")
    assert report["step_version"] == {"here": _core.STEP_VERSION, "there": _core.STEP_VERSION}
    assert report["state_hash"]["here"] != report["state_hash"]["there"]
    assert report["differing"] == len(report["balls"]) == wrong.desyncs[0].differing
    (ball,) = [ball for ball in report["balls"] if ball["id"] == 3]
    bits = ball["bits"]["vx"]
    here, there = (struct.unpack(">d", bytes.fromhex(bits[side]))[0] for side in ("here", "there"))
    assert here != there
    server.signal(2)
    assert server.wait() == 0


def test_a_client_that_was_away_finds_the_rest_in_the_history(start, scene, endpoint, recording):
    """Its ring keeps what is fresh and drops what is old: the older ticks are missing when it is back."""
    server = start("server", scene, "--listen", endpoint, "--rate", 600, "--record", recording.path, "--json")
    with Client(ClientSettings(connect=(endpoint,), name="ana", wait=60.0)) as client:
        reached = client.confirmed.tick
        playing(client, lambda: client.confirmed.tick > reached + 100)
        gone_on = recording.go_on(1500)
        playing(client, lambda: client.confirmed.tick > gone_on)
        playing(client, lambda: client.replica.follower.behind < 60)
        summary = client.summary()
    server.signal(2)
    server.figures()
    assert summary["ticks_healed_by_history"] > 300
    assert summary["snapshots_taken"] == 0
    assert_all_equal(recording.path, [summary])
