"""Real processes over a link with delay, jitter, loss, stalls and cuts: everybody keeps the server's bits.

Through a proxy everywhere, and as root through a tunnel, where real TCP has to live with real loss.
"""

from __future__ import annotations

import re
import signal

import pytest

from e2e.bad_network import Play
from e2e.processes import Command, free_endpoint, until
from e2e.verdict import CHECKING, assert_all_equal
from kuglice.lab.network import Conditions, open_link
from kuglice.lab.network.tun_device import why_impossible

BAD = Conditions(round_trip=0.15, jitter=0.2, loss=0.02, seed=5)
TUNNEL = pytest.param(
    "tunnel", marks=pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")
)


@pytest.fixture(params=["proxy", TUNNEL])
def link(request):
    with open_link(BAD, request.param) as opened:
        yield opened


def test_players_act_and_agree_under_delay_jitter_and_loss(start, scene, tmp_path, link):
    play = Play(start, scene, tmp_path, link)
    players = [play.join("ana", "chaser"), play.join("bob", "herder")]
    play.recording.go_on(240)
    play.recording.acted(*players)
    for figures in play.end(*players):
        assert figures["hashes_checked"] > 150
        assert figures["inputs_accepted"] >= 10
        assert figures["inputs_refused"] == 0
        assert figures["snapshots_taken"] == 0
        assert figures["rejoins"] == 0


def test_a_player_that_was_cut_off_is_missed_and_goes_on_with_its_ball(start, scene, tmp_path, link):
    play = Play(start, scene, tmp_path, link)
    player = play.join("ana", "orbiter")
    play.recording.go_on(60)
    link.cut(5.0)
    until(lambda: "ana (client 1) is away" in play.server.err, what="ana is missed")
    until(lambda: "ana (client 1) is back" in play.server.err, what="ana is back")
    back = play.recording.go_on(0)
    play.recording.go_on(90)
    assert play.server.err.count("ana joins") == 1
    assert "leaves" not in play.server.err
    (figures,) = play.end(player)
    assert figures["number"] == 1
    assert figures["rejoins"] == 0
    assert figures["final_tick"] > back, "she follows what happens, and not only what did"


def assert_left(server: Command, player: Command) -> None:
    """In order; or her patience was over before she was answered, which she then says."""
    if "goodbye was not answered" not in player.err:
        until(lambda: "ana (client 1) leaves" in server.err, what="ana has left in order")
        assert "away" not in server.err


def test_a_goodbye_arrives_though_the_link_is_closed_right_behind_it(start, scene, tmp_path, link):
    play = Play(start, scene, tmp_path, link)
    player = play.join("ana", "orbiter")
    play.recording.go_on(30)
    player.end()
    assert_left(play.server, player)


@pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")
def test_a_goodbye_that_is_lost_at_first_arrives_too(start, scene, tmp_path):
    """Regression: the socket was closed one and a half round trips behind the goodbye, and TCP repeats it later."""
    with open_link(BAD, "tunnel") as link:
        play = Play(start, scene, tmp_path, link)
        player = play.join("ana", "orbiter")
        play.recording.go_on(30)
        link.cut(0.3)
        player.end()
        assert_left(play.server, player)


def test_a_stall_costs_time_and_nothing_else(start, scene, tmp_path, link):
    play = Play(start, scene, tmp_path, link)
    player = play.join("ana", "chaser")
    play.recording.go_on(60)
    link.stall(1.0)
    play.recording.go_on(240)
    assert "leaves" not in play.server.err
    (figures,) = play.end(player)
    assert figures["snapshots_taken"] == 0
    assert figures["hashes_checked"] > 150


def test_a_proxy_by_hand_cuts_and_stalls_a_game_that_goes_on(start, scene, endpoint, recording):
    server = start(
        "server", scene, "--listen", endpoint, "--grace", 600, "--record", recording.path, "--json"
    )
    until(lambda: "balls on" in server.err, what="the server is there")
    here = free_endpoint()
    # However long joining takes here, a cut and a stall are still to come.
    often = [word for at in range(10, 240, 10) for word in ("--cut", f"{at}:2", "--stall", f"{at + 5}:1")]
    proxy = start("proxy", here, endpoint, "--round-trip", 50, *often)
    until(lambda: f"{here} to {endpoint}" in proxy.err, what="the proxy is there")
    player = start("client", *CHECKING, "--connect", here, "--name", "ana", "--bot", "chaser", "--json")
    until(lambda: "joined world" in player.err, what="ana joins")
    until(lambda: "ana (client 1) is away" in server.err, what="ana is missed")
    until(lambda: "ana (client 1) is back" in server.err, what="ana is back")
    seen = proxy.err.count("stall for 1 s")
    until(lambda: proxy.err.count("stall for 1 s") > seen, what="a stall")
    player.signal(signal.SIGINT)
    figures = player.figures()
    server.end()
    proxy.signal(signal.SIGINT)
    assert proxy.wait() == 0
    assert re.search(r"^down tcp bytes: [\d,]+$", proxy.err, re.MULTILINE)
    assert figures["rejoins"] == 0
    assert_all_equal(recording.path, [figures])


def test_packets_that_overtake_and_come_twice_change_nothing(start, scene, tmp_path, link):
    link.change(Conditions(round_trip=0.1, jitter=0.5, loss=0.02, duplicate=0.1, reorder=True, seed=5))
    play = Play(start, scene, tmp_path, link)
    player = play.join("ana", "orbiter")
    play.recording.go_on(240)
    play.recording.acted(player)
    (figures,) = play.end(player)
    assert figures["inputs_accepted"] >= 5
    assert figures["hashes_checked"] > 100
