"""`kuglice router`: clients behind it have the server's bits, and it exposes nothing unasked."""

from __future__ import annotations

from e2e.processes import free_endpoint, until
from e2e.verdict import CHECKING, assert_all_equal


def test_clients_behind_a_router_agree_on_every_state(start, server, endpoint, recording):
    door = free_endpoint()
    start("router", "--connect", endpoint, "--listen", door)
    player = start(*("client", *CHECKING, "--connect", door, "--bot", "chaser", "--wait", 60, "--json"))
    until(lambda: "joined world" in player.err, what="a client joins")
    recording.go_on(120)
    recording.acted(player)
    figures = player.end()
    server.end()
    assert_all_equal(recording.path, [figures])
    assert figures["inputs_accepted"] > 0
    assert figures["snapshots_checked"] > 0


def test_an_address_that_others_reach_is_refused(start):
    router = start("router", "--listen", "tcp/0.0.0.0:0")
    assert router.wait() == 2
    assert "--insecure" in router.err


def test_a_router_may_come_before_its_server(start, scene, endpoint):
    door = free_endpoint()
    router = start("router", "--connect", endpoint, "--listen", door)
    until(lambda: "router from" in router.err, what="the router is there")
    start("server", scene, "--listen", endpoint)
    player = start("client", "--connect", door, "--name", "ana", "--wait", 60, "--seconds", 1, "--json")
    assert player.figures()["agreed"]
