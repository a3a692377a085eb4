"""Tokens become joins and leaves; names become numbers; a name that returns is the same player."""

from __future__ import annotations

import pytest

from kuglice import World
from kuglice.errors import InputError
from kuglice.inputs import Join, Leave
from kuglice_server.counters import Counters
from kuglice_server.players import MAX_NAMES, Players
from server.small_arena import small_arena

GRACE = 30


@pytest.fixture
def world():
    return World(small_arena())


@pytest.fixture
def players():
    return Players(small_arena(), grace=GRACE, counters=Counters())


def turn(players: Players, world: World) -> list:
    """One tick of the server, as far as players are concerned."""
    authored = players.authored(world)
    world.step(authored)
    return authored


def refused(players: Players, name: str, session: str) -> str | None:
    return players.admission(name, session, epoch=1).refused


def test_everyone_gets_a_number_and_a_ball_of_their_own(players, world):
    for name in ("ana", "bob"):
        players.arrive(name, "s1")
    joins = turn(players, world) + turn(players, world)
    assert [type(one) for one in joins] == [Join, Join]
    assert {(one.x, one.y) for one in joins} == {(1.0, 1.0), (19.0, 9.0)}
    assert [client for client, ball in world.players if ball is not None] == [1, 2]
    assert {name: status.number for name, status in players.status().items()} == {"ana": 1, "bob": 2}


def test_a_token_seen_twice_joins_once(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    players.arrive("ana", "s1")
    assert turn(players, world) == []


def test_leaving_takes_the_ball_along(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    balls = world.count
    players.leave("ana", "s1")
    assert [type(one) for one in turn(players, world)] == [Leave]
    assert world.count == balls - 1
    assert world.players == []


def test_a_name_that_returns_keeps_number_and_sequence(players, world):
    for name in ("ana", "bob"):
        players.arrive(name, "s1")
        turn(players, world)
    players.find("ana", "s1").sequence = 41
    players.leave("ana", "s1")
    turn(players, world)
    assert players.find("ana", "s1") is None
    players.arrive("ana", "s1")
    turn(players, world)
    assert (players.status()["ana"].number, players.status()["ana"].sequence) == (1, 41)


def test_one_too_many_is_told_why_and_may_come_when_there_is_room(players, world):
    for name in ("ana", "bob", "cid"):
        players.arrive(name, "s1")
        turn(players, world)
    assert "at most 2" in refused(players, "cid", "s1")
    players.leave("ana", "s1")
    players.depart("cid", "s1", world.tick)
    turn(players, world)
    players.arrive("cid", "s1")
    turn(players, world)
    assert refused(players, "cid", "s1") is None
    assert players.find("cid", "s1") is not None


def test_coming_and_going_within_one_tick_leaves_nothing_behind(players, world):
    players.arrive("ana", "s1")
    players.leave("ana", "s1")
    assert turn(players, world) == []
    assert players.status() == {}


def test_everybody_gone_is_not_the_same_as_nobody_yet(players, world):
    assert not players.deserted
    players.arrive("ana", "s1")
    turn(players, world)
    assert not players.deserted
    players.leave("ana", "s1")
    assert players.deserted


def test_players_without_balls_where_the_scene_has_none():
    scene = small_arena().model_copy(update={"players": None})
    players, world = Players(scene, grace=GRACE, counters=Counters()), World(scene)
    players.arrive("ana", "s1")
    turn(players, world)
    assert world.players == [(1, None)]


def away(players: Players, world: World, ticks: int) -> list:
    """What the server writes in that many ticks after ana's token has vanished."""
    players.depart("ana", "s1", world.tick)
    return [one for _ in range(ticks) for one in turn(players, world)]


def test_one_whose_link_was_cut_keeps_its_ball_and_goes_on_with_it(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    balls = dict(world.players)
    assert away(players, world, GRACE) == []
    assert players.status()["ana"].away
    assert not players.deserted
    players.arrive("ana", "s1")
    assert [turn(players, world) for _ in range(2 * GRACE)] == [[]] * 2 * GRACE
    assert not players.status()["ana"].away
    assert dict(world.players) == balls


def test_inputs_of_one_who_is_away_are_still_its_own(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    away(players, world, 3)
    assert players.find("ana", "s1") is not None


def test_one_who_does_not_come_back_in_time_leaves(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    assert [type(one) for one in away(players, world, GRACE + 1)] == [Leave]
    assert players.find("ana", "s1") is None
    players.arrive("ana", "s1")
    (join,) = turn(players, world)
    assert join.client == 1


def test_a_name_is_played_by_one_session_and_the_second_is_told_why(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    players.arrive("ana", "s2")
    assert turn(players, world) == []
    assert "ana is played by another session already, at most 1" in refused(players, "ana", "s2")
    assert players.find("ana", "s2") is None
    assert players.admission("ana", "s1", epoch=1).number == 1
    # It goes, and the one who plays does not notice.
    players.depart("ana", "s2", world.tick)
    players.leave("ana", "s2")
    assert turn(players, world) == []
    assert refused(players, "ana", "s2") is None
    assert players.find("ana", "s1") is not None


def test_a_new_session_waits_while_the_old_one_may_come_back_and_then_plays_on(players, world):
    """Of a client that crashed and was started again, say."""
    players.arrive("ana", "s1")
    turn(players, world)
    players.arrive("bob", "s1")
    turn(players, world)
    players.depart("ana", "s1", world.tick)
    players.arrive("ana", "s2")
    written = [one for _ in range(GRACE + 2) for one in turn(players, world)]
    assert [(type(one), one.client) for one in written] == [(Leave, 1), (Join, 1)]
    assert refused(players, "ana", "s2") is None
    assert players.find("ana", "s2") is not None
    assert players.find("ana", "s1") is None


def test_one_who_says_goodbye_is_not_waited_for(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    players.leave("ana", "s1")
    assert [type(one) for one in turn(players, world)] == [Leave]
    # Its token vanishes only now.
    players.depart("ana", "s1", world.tick)
    assert away(players, world, GRACE + 1) == []


def test_who_comes_when_too_many_wait_is_counted_and_comes_in_once_there_is_room(world):
    counters = Counters()
    players = Players(small_arena(), grace=GRACE, counters=counters)
    for number in range(MAX_NAMES):
        players.arrive(f"early-{number}", "s1")
    players.arrive("early-7", "s1")
    assert counters.all() == {}, "one that waits already takes no more room"
    players.arrive("late", "s1")
    assert counters.all() == {"arrivals_ignored": 1}
    for number in range(MAX_NAMES):
        players.depart(f"early-{number}", "s1", world.tick)
    assert turn(players, world) == []
    players.arrive("late", "s1")
    turn(players, world)
    assert players.find("late", "s1") is not None
    assert counters["arrivals_ignored"] == 1


def test_one_who_is_dismissed_leaves_and_its_session_stays_out(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    balls = world.count
    players.dismiss("ana", "enough")
    assert [type(one) for one in turn(players, world)] == [Leave]
    assert world.count == balls - 1
    assert players.settled("ana", "s1")
    assert refused(players, "ana", "s1") == "dismissed: enough"
    # Its link is opened anew, the old one's end is told first.
    players.depart("ana", "s1", world.tick)
    players.arrive("ana", "s1")
    assert [turn(players, world) for _ in range(3)] == [[], [], []]
    assert refused(players, "ana", "s1") == "dismissed: enough"
    players.arrive("ana", "s2")
    (join,) = turn(players, world)
    assert join.client == 1
    assert refused(players, "ana", "s2") is None
    assert refused(players, "ana", "s1") == "dismissed: enough"


def test_one_who_is_away_can_be_dismissed_too(players, world):
    players.arrive("ana", "s1")
    turn(players, world)
    players.depart("ana", "s1", world.tick)
    players.dismiss("ana", "enough")
    assert [type(one) for one in turn(players, world)] == [Leave]
    with pytest.raises(InputError, match="must be one of those who play, 0 now"):
        players.dismiss("ana", "enough")
