"""Everything stops in order, whoever says so, and leaves whole files."""

from __future__ import annotations

import json
import signal

import pytest

from e2e.processes import free_endpoint, until
from e2e.verdict import assert_all_equal
from kuglice.replay import Replay


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_server_that_is_told_to_stop_finishes_its_recording(server, join, recording, number):
    player = join("--bot", "chaser")
    reached = recording.go_on(60)
    server.signal(number)
    assert server.figures()["ticks"] >= reached
    player.signal(number)
    assert_all_equal(recording.path, [player.figures()])


def test_a_server_that_is_killed_leaves_what_it_had(server, join, recording):
    spectator = join()
    recording.go_on(60)
    figures = spectator.end()
    server.kill()
    assert_all_equal(recording.path, [figures], complete=False)


def test_a_client_that_is_killed_is_missed_by_the_server(start, scene, endpoint, join, recording):
    server = start("server", scene, "--listen", endpoint, "--record", recording.path, "--grace", 1, "--json")
    player = join("--name", "ana")
    until(lambda: "ana joins as client 1" in server.err, what="ana joins")
    player.kill()
    until(lambda: "ana (client 1) leaves" in server.err, what="ana is missed")
    assert server.end()["balls"] == 12
    assert Replay.load(recording.path).verify().ok


def test_a_client_that_finds_nobody_says_so_and_ends(start):
    lonely = start("client", "--connect", free_endpoint(), "--wait", 0.5)
    assert lonely.wait() == 2
    assert "cannot connect to" in lonely.err


def test_a_world_that_is_full_refuses_in_words(start, join, tmp_path, endpoint):
    from server.small_arena import small_arena  # noqa: PLC0415

    small_arena(players=1).save(tmp_path / "tiny.toml")
    start("server", tmp_path / "tiny.toml", "--listen", endpoint)
    join("--name", "ana")
    second = start("client", "--connect", endpoint, "--name", "bob")
    assert second.wait() == 2
    assert "at most 1" in second.err


def test_an_address_that_others_reach_is_refused(start, scene):
    server = start("server", scene, "--listen", "tcp/0.0.0.0:0")
    assert server.wait() == 2
    assert "--insecure" in server.err


def test_the_summary_file_holds_what_is_printed(server, join, recording, tmp_path):
    path = tmp_path / "deep" / "summary.json"
    client = join("--summary-json", path)
    # One that had nothing to compare ends with 1.
    recording.go_on(60)
    assert client.end() == json.loads(path.read_text())


def test_a_second_session_under_a_name_that_plays_is_refused_in_words(
    server, start, join, endpoint, recording
):
    first = join("--name", "ana", "--bot", "chaser")
    second = start("client", "--connect", endpoint, "--name", "ana", "--bot", "herder", "--json")
    assert second.wait() == 2
    assert "client ana: join: ana is played by another session already" in second.err
    recording.go_on(60)
    figures = first.end()
    server.end()
    assert server.err.count("ana joins") == 1
    assert figures["inputs_refused"] == 0
    assert_all_equal(recording.path, [figures])


def test_a_client_started_again_after_a_crash_waits_for_its_own_end_and_plays_on(
    start, join, scene, endpoint
):
    server = start("server", scene, "--listen", endpoint, "--grace", 1)
    join("--name", "ana").kill()
    until(lambda: "is away" in server.err, what="ana is missed")
    figures = join("--name", "ana").end()
    assert (figures["number"], figures["agreed"]) == (1, True)
    assert server.err.count("ana joins as client 1") == 2


def test_one_who_leaves_in_order_is_not_waited_for(start, join, scene, endpoint):
    server = start("server", scene, "--listen", endpoint, "--grace", 3600)
    join("--name", "ana").end()
    until(lambda: "ana (client 1) leaves" in server.err, what="ana leaves")


def test_a_client_that_freezes_is_missed_and_may_come_back(start, join, scene, endpoint, recording):
    server = start(
        "server", scene, "--listen", endpoint, "--record", recording.path, "--grace", 600, "--json"
    )
    player = join("--name", "ana", "--bot", "chaser")
    player.signal(signal.SIGSTOP)
    until(lambda: "ana (client 1) is away" in server.err, what="ana is missed")
    player.signal(signal.SIGCONT)
    until(lambda: "ana (client 1) is back" in server.err, what="ana is back")
    recording.go_on(90)
    figures = player.end()
    server.end()
    assert_all_equal(recording.path, [figures])
