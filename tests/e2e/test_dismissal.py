"""The host of a game takes a player out of it: it is told why, and ends; everybody else plays on."""

from __future__ import annotations

import logging
import threading

import pytest

from e2e.processes import until
from e2e.serving import serving
from kuglice.errors import InputError, JoinError
from kuglice_client import Client, ClientSettings
from kuglice_server import Server

WORLD = "small"
WHY = "too many goals with the hand"


@pytest.fixture
def served():
    with serving(WORLD) as served:
        yield served


def settings(endpoint: str, name: str | None) -> ClientSettings:
    bot = None if name is None else "chaser"
    return ClientSettings(connect=(endpoint,), world=WORLD, name=name, bot=bot, wait=60.0)


def test_its_client_is_told_why_and_ends_instead_of_joining_again(served, caplog):
    endpoint, server = served
    with Client(settings(endpoint, "ana")) as ana, Client(settings(endpoint, "bob")) as bob:
        ana.run(seconds=0.2)
        dismissing = threading.Timer(0.2, server.dismiss, ("ana", WHY))
        dismissing.start()
        with (
            caplog.at_level(logging.WARNING),
            pytest.raises(JoinError, match=f"^client ana: dismissed: {WHY}$"),
        ):
            ana.run(seconds=60)
        dismissing.join()
        assert ana.totals.rejoins == 0
        assert not [record for record in caplog.records if "joins again" in record.message]
        assert list(server.status().clients) == ["bob"]
        until(
            lambda: bob.run(seconds=0.1) or [client for client, _ in bob.confirmed.players] == [2],
            what="bob sees that ana has left",
        )
        assert bob.summary()["agreed"]
        assert bob.summary()["rejoins"] == 0


def test_who_was_dismissed_may_come_back_as_a_new_session_and_go_on_as_the_same_player(served):
    endpoint, server = served
    with Client(settings(endpoint, "ana")) as ana:
        number = ana.replica.joined.number
        server.dismiss("ana", WHY)
        with pytest.raises(JoinError, match=WHY):
            ana.run(seconds=60)
        with Client(settings(endpoint, "ana")) as again:
            assert again.replica.joined.number == number
            again.run(seconds=0.2)
            assert list(server.status().clients) == ["ana"]
            # The first one is told the same still, and does not speak for the second.
            with pytest.raises(JoinError, match=WHY):
                ana.run(seconds=60)


def test_the_command_ends_with_the_reason(served, join):
    endpoint, server = served
    client = join("--name", "ana", "--bot", "chaser", "--connect", endpoint)
    server.dismiss("ana", WHY)
    assert client.wait() == 2
    assert f"client ana: dismissed: {WHY}" in client.err
    assert "joins again" not in client.err


def test_who_does_not_play_cannot_be_dismissed(served):
    endpoint, server = served
    with Client(settings(endpoint, None)) as spectator:
        spectator.run(seconds=0.1)
        with pytest.raises(InputError, match="dismiss 'ana': must be one of those who play, 0 now"):
            server.dismiss("ana", WHY)


@pytest.mark.parametrize("reason", ["", "o" * 500])
def test_a_reason_that_nobody_could_be_told_is_refused(served, reason):
    with pytest.raises(InputError, match=f"a reason of {len(reason)} characters, must be 1 to 389"):
        served[1].dismiss("ana", reason)


def test_rules_of_a_game_dismiss_between_two_ticks():
    def rules(server: Server) -> None:
        if "ana" in server.status().clients:
            server.dismiss("ana", WHY)

    with (
        serving(WORLD, rules) as (endpoint, _),
        pytest.raises(JoinError, match=f"client ana: dismissed: {WHY}"),
    ):
        # However early: while it joins, too.
        Client(settings(endpoint, "ana")).run(seconds=60)
