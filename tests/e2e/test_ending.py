"""Everything stops in order, whoever says so, and leaves whole files."""

from __future__ import annotations

import json
import signal

import pytest

from e2e.processes import free_endpoint, until
from e2e.verdict import assert_all_equal
from kuglice.replay import Replay


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_server_that_is_told_to_stop_finishes_its_recording(server, start, endpoint, tmp_path, number):
    player = start("client", "--connect", endpoint, "--bot", "chaser", "--json")
    until(lambda: "joined world" in player.err, what="a client joins")
    joined = len(Replay.load(tmp_path / "run.kuglice"))
    until(lambda: len(Replay.load(tmp_path / "run.kuglice")) > joined + 60, what="a second of play")
    server.signal(number)
    assert server.figures()["ticks"] > joined + 60
    player.signal(number)
    assert_all_equal(tmp_path / "run.kuglice", [player.figures()])


def test_a_server_that_is_killed_leaves_what_it_had(server, endpoint, start, tmp_path):
    player = start("client", "--connect", endpoint, "--seconds", 1, "--json")
    figures = player.figures()
    server.kill()
    assert_all_equal(tmp_path / "run.kuglice", [figures], complete=False)


def test_a_client_that_is_killed_is_missed_by_the_server(server, start, endpoint, tmp_path):
    player = start("client", "--connect", endpoint, "--name", "ana", "--json")
    until(lambda: "ana joins as client 1" in server.err, what="ana joins")
    player.kill()
    until(lambda: "ana (client 1) leaves" in server.err, what="ana is missed")
    server.signal(signal.SIGINT)
    assert server.figures()["balls"] == 12
    assert Replay.load(tmp_path / "run.kuglice").verify().ok


def test_a_client_that_finds_nobody_says_so_and_ends(start):
    lonely = start("client", "--connect", free_endpoint(), "--wait", 0.5)
    assert lonely.wait() == 2
    assert "cannot connect to" in lonely.err


def test_a_world_that_is_full_refuses_in_words(start, tmp_path, endpoint):
    from server.small_arena import small_arena  # noqa: PLC0415

    small_arena(players=1).save(tmp_path / "tiny.toml")
    start("server", tmp_path / "tiny.toml", "--listen", endpoint)
    first = start("client", "--connect", endpoint, "--name", "ana")
    until(lambda: "joined world" in first.err, what="ana joins")
    second = start("client", "--connect", endpoint, "--name", "bob")
    assert second.wait() == 2
    assert "at most 1" in second.err


def test_an_address_that_others_reach_is_refused(start, scene):
    server = start("server", scene, "--listen", "tcp/0.0.0.0:0")
    assert server.wait() == 2
    assert "--insecure" in server.err


def test_the_summary_file_holds_what_is_printed(server, start, endpoint, tmp_path):
    path = tmp_path / "deep" / "summary.json"
    player = start("client", "--connect", endpoint, "--seconds", 1, "--summary-json", path, "--json")
    assert player.figures() == json.loads(path.read_text())


def test_a_second_session_under_a_name_that_plays_is_refused_in_words(server, start, endpoint, tmp_path):
    first = start("client", "--connect", endpoint, "--name", "ana", "--bot", "chaser", "--json")
    until(lambda: "joined world" in first.err, what="ana joins")
    second = start("client", "--connect", endpoint, "--name", "ana", "--bot", "herder", "--json")
    assert second.wait() == 2
    assert "client ana: join: ana is played by another session already" in second.err
    reached = len(Replay.load(tmp_path / "run.kuglice"))
    until(lambda: len(Replay.load(tmp_path / "run.kuglice")) > reached + 60, what="the first plays on")
    first.signal(signal.SIGINT)
    figures = first.figures()
    server.signal(signal.SIGINT)
    server.figures()
    assert server.err.count("ana joins") == 1
    assert figures["inputs_refused"] == 0
    assert_all_equal(tmp_path / "run.kuglice", [figures])


def test_a_client_started_again_after_a_crash_waits_for_its_own_end_and_plays_on(
    start, scene, endpoint, tmp_path
):
    server = start("server", scene, "--listen", endpoint, "--grace", 1)
    first = start("client", "--connect", endpoint, "--name", "ana", "--json")
    until(lambda: "joined world" in first.err, what="ana joins")
    first.kill()
    until(lambda: "is away" in server.err, what="ana is missed")
    again = start("client", "--connect", endpoint, "--name", "ana", "--seconds", 1, "--wait", 20, "--json")
    figures = again.figures()
    assert (figures["number"], figures["agreed"]) == (1, True)
    assert server.err.count("ana joins as client 1") == 2


def test_one_who_leaves_in_order_is_not_waited_for(start, scene, endpoint):
    server = start("server", scene, "--listen", endpoint, "--grace", 3600)
    player = start("client", "--connect", endpoint, "--name", "ana", "--seconds", 1, "--json")
    player.figures()
    until(lambda: "ana (client 1) leaves" in server.err, what="ana leaves")


def test_a_client_that_freezes_is_missed_and_may_come_back(server, start, endpoint, tmp_path):
    player = start("client", "--connect", endpoint, "--name", "ana", "--bot", "chaser", "--json")
    until(lambda: "ana joins as client 1" in server.err, what="ana joins")
    player.signal(signal.SIGSTOP)
    until(lambda: "ana (client 1) is away" in server.err, what="ana is missed")
    player.signal(signal.SIGCONT)
    until(lambda: "ana (client 1) is back" in server.err, what="ana is back")
    reached = Replay.load(tmp_path / "run.kuglice")
    until(lambda: len(Replay.load(tmp_path / "run.kuglice")) > len(reached) + 90, what="she plays on")
    player.signal(signal.SIGINT)
    figures = player.figures()
    server.signal(signal.SIGINT)
    server.figures()
    assert_all_equal(tmp_path / "run.kuglice", [figures])
