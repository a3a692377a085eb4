"""Tokens become joins and leaves; names become numbers; a name that returns is the same player."""

from __future__ import annotations

import pytest

from kuglice import World
from kuglice.inputs import Join, Leave
from kuglice_server.players import Players
from server.small_arena import small_arena


@pytest.fixture
def world():
    return World(small_arena())


@pytest.fixture
def players():
    return Players(small_arena())


def turn(players: Players, world: World) -> list:
    """One tick of the server, as far as players are concerned."""
    authored = players.authored(world)
    world.step(authored)
    return authored


def test_everyone_gets_a_number_and_a_ball_of_their_own(players, world):
    for name in ("ana", "bob"):
        players.arrive(name)
    joins = turn(players, world) + turn(players, world)
    assert [type(one) for one in joins] == [Join, Join]
    assert {(one.x, one.y) for one in joins} == {(1.0, 1.0), (19.0, 9.0)}
    assert [client for client, ball in world.players if ball is not None] == [1, 2]
    assert {name: status.number for name, status in players.status().items()} == {"ana": 1, "bob": 2}


def test_a_token_seen_twice_joins_once(players, world):
    players.arrive("ana")
    turn(players, world)
    players.arrive("ana")
    assert turn(players, world) == []


def test_leaving_takes_the_ball_along(players, world):
    players.arrive("ana")
    turn(players, world)
    balls = world.count
    players.depart("ana")
    assert [type(one) for one in turn(players, world)] == [Leave]
    assert world.count == balls - 1
    assert world.players == []


def test_a_name_that_returns_keeps_number_and_sequence(players, world):
    for name in ("ana", "bob"):
        players.arrive(name)
        turn(players, world)
    players.find("ana").sequence = 41
    players.depart("ana")
    turn(players, world)
    assert players.find("ana") is None
    players.arrive("ana")
    turn(players, world)
    assert (players.status()["ana"].number, players.status()["ana"].sequence) == (1, 41)


def test_one_too_many_is_told_why_and_may_come_when_there_is_room(players, world):
    for name in ("ana", "bob", "cid"):
        players.arrive(name)
        turn(players, world)
    assert "at most 2" in players.status()["cid"].refusal
    players.depart("ana")
    players.depart("cid")
    turn(players, world)
    players.arrive("cid")
    turn(players, world)
    assert players.status()["cid"].refusal is None
    assert players.find("cid") is not None


def test_coming_and_going_within_one_tick_leaves_nothing_behind(players, world):
    players.arrive("ana")
    players.depart("ana")
    assert turn(players, world) == []
    assert players.status() == {}


def test_everybody_gone_is_not_the_same_as_nobody_yet(players, world):
    assert not players.deserted
    players.arrive("ana")
    turn(players, world)
    assert not players.deserted
    players.depart("ana")
    assert players.deserted


def test_players_without_balls_where_the_scene_has_none():
    scene = small_arena().model_copy(update={"players": None})
    players, world = Players(scene), World(scene)
    players.arrive("ana")
    turn(players, world)
    assert world.players == [(1, None)]
