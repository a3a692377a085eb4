"""The main job: a server, clients that come when they like, inputs flying, and equal bits everywhere."""

from __future__ import annotations

import pytest

from e2e.processes import until
from e2e.verdict import CHECKING, assert_all_equal


def test_two_clients_and_a_server_agree_on_every_state(start, server, endpoint, tmp_path):
    players = [
        start("client", *CHECKING, "--connect", endpoint, "--bot", bot, "--seconds", 3, "--json")
        for bot in ("chaser", "herder")
    ]
    figures = [player.figures() for player in players]
    server.signal(2)
    served = server.figures()
    assert_all_equal(tmp_path / "run.kuglice", figures)
    for client in figures:
        assert client["hashes_checked"] >= 100
        assert client["snapshots_checked"] >= 3
        assert client["inputs_accepted"] >= 10
        assert client["inputs_refused"] == 0
        assert client["rejoins"] == 0
    assert served["inputs_applied"] >= sum(client["inputs_accepted"] for client in figures)


def test_without_being_asked_to_check_them_a_client_gets_no_snapshots_and_none_are_made(
    start, server, endpoint, tmp_path
):
    arguments = ("client", "--connect", endpoint, "--bot", "chaser", "--seconds", 2, "--json")
    plain = start(*arguments).figures()
    served = start(*arguments, "--check-snapshots").figures()
    server.signal(2)
    counts = server.figures()
    assert_all_equal(tmp_path / "run.kuglice", [plain, served])
    assert (plain["snapshots_checked"], plain["bytes_per_second_snapshots"]) == (0, 0)
    assert served["bytes_per_second_snapshots"] > 0
    # Made while the second one listened, and not before.
    assert 0 < served["snapshots_checked"] <= counts["snapshots_out"] < counts["ticks"] // 20 - 4


def test_a_late_joiner_agrees_from_its_snapshot_on(start, server, endpoint, tmp_path):
    early = start("client", *CHECKING, "--connect", endpoint, "--bot", "orbiter", "--seconds", 4, "--json")
    until(lambda: "joined world" in early.err, what="the first client joins")
    late = start("client", *CHECKING, "--connect", endpoint, "--bot", "chaser", "--seconds", 1.5, "--json")
    watcher = start("client", *CHECKING, "--connect", endpoint, "--seconds", 1.5, "--json")
    figures = [early.figures(), late.figures(), watcher.figures()]
    server.signal(2)
    server.figures()
    assert_all_equal(tmp_path / "run.kuglice", figures)
    assert figures[1]["hashes_checked"] < figures[0]["hashes_checked"]
    assert figures[2]["number"] is None


@pytest.mark.parametrize("share", [0.2, 0.7])
def test_a_client_that_misses_messages_heals(start, server, endpoint, tmp_path, share):
    player = start(
        *("client", *CHECKING, "--connect", endpoint, "--bot", "orbiter", "--seconds", 3, "--lose", share),
        "--json",
    )
    figures = player.figures()
    server.signal(2)
    server.figures()
    assert_all_equal(tmp_path / "run.kuglice", [figures])
    assert figures["messages_thrown_away"] >= 10
    assert figures["ticks_healed_by_repeats"] > 0
    assert figures["snapshots_taken"] == 0, "messages that are lost are no reason to give the state up"


def test_a_world_that_runs_at_another_rate_has_the_same_bits(start, scene, endpoint, tmp_path):
    record = tmp_path / "fast.kuglice"
    server = start(
        "server", scene, "--listen", endpoint, "--rate", 240, "--record", record, "--until-empty", "--json"
    )
    player = start("client", *CHECKING, "--connect", endpoint, "--bot", "chaser", "--seconds", 2, "--json")
    figures = player.figures()
    assert server.figures()["ticks"] > 300
    assert_all_equal(record, [figures])


def test_through_a_router_that_runs_already(start, scene, endpoint, tmp_path):
    """The server joins a router instead of being one; the router here is a session of this process."""
    from kuglice.protocol import close_session, open_session, server_configuration  # noqa: PLC0415

    router = open_session(server_configuration(listen=[endpoint], connect=[]))
    try:
        record = tmp_path / "run.kuglice"
        server = start("server", scene, "--connect", endpoint, "--record", record, "--until-empty", "--json")
        player = start(
            "client", *CHECKING, "--connect", endpoint, "--bot", "chaser", "--seconds", 2, "--json"
        )
        figures = player.figures()
        server.figures()
        assert_all_equal(record, [figures])
    finally:
        close_session(router, [])
