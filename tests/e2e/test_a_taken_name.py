"""Regression: a client that had lost its player to another session played on as a ghost, without a word.

It was stopped for longer than the server waits, and another session took the name. Back again it was refused, read that
nowhere, took the other's ball for its own, sent inputs that were foreign, and ended with status 0.
"""

from __future__ import annotations

import signal

import pytest

from e2e.processes import until

VIC = ("--name", "vic", "--bot", "orbiter")


@pytest.fixture
def given_up(start, endpoint, scene, join):
    """A server, and a client that is stopped and that the server waits for no more."""
    server = start("server", scene, "--listen", endpoint, "--grace", 0.5, "--json")
    player = join(*VIC)
    player.signal(signal.SIGSTOP)
    until(lambda: "vic (client 1) leaves" in server.err, what="it is given up", seconds=60)
    return server, player


def test_who_has_lost_its_name_to_another_says_so_and_ends(given_up, join):
    server, first = given_up
    second = join(*VIC)
    first.signal(signal.SIGCONT)
    assert first.wait() == 2
    assert "the server has given client vic up" in first.err
    assert "vic is played by another session already" in first.err
    second.signal(signal.SIGINT)
    figures = second.figures()
    assert figures["agreed"]
    assert figures["rejoins"] == 0
    server.signal(signal.SIGINT)
    assert "foreign" not in server.figures()


def test_who_was_given_up_and_finds_its_name_free_plays_on(given_up):
    server, player = given_up
    player.signal(signal.SIGCONT)
    until(lambda: server.err.count("vic joins as client 1") == 2, what="it is let in again")
    player.signal(signal.SIGINT)
    assert player.figures()["agreed"]
    server.signal(signal.SIGINT)
    server.figures()
