"""The main job: a server, clients that come when they like, inputs flying, and equal bits everywhere."""

from __future__ import annotations

import pytest

from e2e.verdict import CHECKING, assert_all_equal
from kuglice.protocol import close_session, open_session, server_configuration

TICKS = 240
"""Of play: well above what is asked of a client, which may be some of them behind when it is told to end."""


def test_two_clients_and_a_server_agree_on_every_state(join, server, recording):
    players = [join(*CHECKING, "--bot", bot) for bot in ("chaser", "herder")]
    recording.go_on(TICKS)
    recording.acted(*players)
    figures = [player.end() for player in players]
    served = server.end()
    assert_all_equal(recording.path, figures)
    for client in figures:
        assert client["hashes_checked"] >= 100
        assert client["snapshots_checked"] >= 3
        assert client["inputs_accepted"] >= 10
        assert client["inputs_refused"] == 0
        assert client["rejoins"] == 0
    assert served["inputs_applied"] >= sum(client["inputs_accepted"] for client in figures)


def test_without_being_asked_to_check_them_a_client_gets_no_snapshots_and_none_are_made(
    join, server, recording
):
    figures = []
    for asked in ((), CHECKING):
        client = join("--bot", "chaser", *asked)
        recording.go_on(150)
        figures.append(client.end())
    plain, served = figures
    counts = server.end()
    assert_all_equal(recording.path, figures)
    assert (plain["snapshots_checked"], plain["bytes_per_second_snapshots"]) == (0, 0)
    assert served["bytes_per_second_snapshots"] > 0
    # Made while the second one listened, and not before.
    assert 0 < served["snapshots_checked"] <= counts["snapshots_out"] < counts["ticks"] // 20 - 4


def test_a_late_joiner_agrees_from_its_snapshot_on(join, server, recording):
    early = join(*CHECKING, "--bot", "orbiter")
    recording.go_on(60)
    late, watcher = join(*CHECKING, "--bot", "chaser"), join(*CHECKING)
    recording.go_on(90)
    figures = [client.end() for client in (late, watcher, early)]
    server.end()
    assert_all_equal(recording.path, figures)
    assert figures[0]["hashes_checked"] < figures[2]["hashes_checked"]
    assert figures[1]["number"] is None


@pytest.mark.parametrize("share", [0.2, 0.7])
def test_a_client_that_misses_messages_heals(join, server, recording, share):
    player = join(*CHECKING, "--bot", "orbiter", "--lose", share)
    recording.go_on(TICKS)
    figures = player.end()
    server.end()
    assert_all_equal(recording.path, [figures])
    assert figures["messages_thrown_away"] >= 10
    assert figures["ticks_healed_by_repeats"] > 0
    assert figures["snapshots_taken"] == 0, "messages that are lost are no reason to give the state up"


def test_a_world_that_runs_at_another_rate_has_the_same_bits(start, join, scene, endpoint, recording):
    server = start(
        *("server", scene, "--listen", endpoint, "--rate", 240, "--record", recording.path),
        *("--until-empty", "--json"),
    )
    player = join(*CHECKING, "--bot", "chaser")
    recording.go_on(300)
    figures = player.end()
    assert server.figures()["ticks"] > 300
    assert_all_equal(recording.path, [figures])


def test_through_a_router_that_runs_already(start, join, scene, endpoint, recording):
    """The server joins a router instead of being one; the router here is a session of this process."""
    router = open_session(server_configuration(listen=[endpoint], connect=[]))
    try:
        server = start(
            *("server", scene, "--connect", endpoint, "--record", recording.path),
            *("--until-empty", "--json"),
        )
        player = join(*CHECKING, "--bot", "chaser")
        recording.go_on(60)
        figures = player.end()
        server.figures()
        assert_all_equal(recording.path, [figures])
    finally:
        close_session(router, [])
