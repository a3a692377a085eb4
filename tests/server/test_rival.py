"""Regression: two servers of one world met at one router without a word, and clients heard the ticks of both."""

from __future__ import annotations

import re
from contextlib import ExitStack

import pytest

from e2e.processes import free_endpoint
from kuglice.errors import NetworkError
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena


@pytest.fixture
def made():
    with ExitStack() as stack:

        def make(world: str, listen: tuple[str, ...], connect: tuple[str, ...] = ()) -> Server:
            settings = ServerSettings(world=world, listen=listen, connect=connect)
            return stack.enter_context(Server(small_arena(), settings))

        yield make


def test_a_second_server_of_a_world_is_refused_where_it_connects(made):
    endpoint = free_endpoint()
    made("arena", (endpoint,))
    told = f"world arena: another server serves it at {endpoint} already, at tick 0; end that one"
    with pytest.raises(NetworkError, match=re.escape(told)):
        made("arena", (), (endpoint,))


def test_worlds_of_other_names_are_welcome_there(made):
    endpoint = free_endpoint()
    made("arena", (endpoint,))
    assert made("garden", (), (endpoint,)).about().world == "garden"


def test_whoever_ended_makes_room_for_the_next_one(made):
    hub, name = free_endpoint(), "arena"
    made("hub", (hub,))
    made(name, (), (hub,)).close()
    assert made(name, (), (hub,)).about().world == name
