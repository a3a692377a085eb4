"""Regression: with `--grace 0` a client that opened its link anew lost its ball if a tick fell between the end of its
old session and the beginning of the new one, and played on without one if they were told the other way round."""

from __future__ import annotations

import pytest

from kuglice import World
from kuglice.inputs import Leave
from kuglice_server.cadence import Cadence
from kuglice_server.counters import Counters
from kuglice_server.players import Players
from kuglice_server.settings import ServerSettings
from server.small_arena import small_arena

RATE = 60


@pytest.fixture
def world():
    return World(small_arena())


@pytest.fixture
def players(world):
    cadence = Cadence.of(ServerSettings(world="arena", rate=RATE, grace=0.0), world)
    players = Players(world.scene, grace=cadence.grace, counters=Counters())
    players.arrive("ana", "s1")
    run(players, world, 1)
    return players


def run(players: Players, world: World, ticks: int) -> list:
    """What the server itself does in so many ticks."""
    done = []
    for _ in range(ticks):
        authored = players.authored(world)
        world.step(authored)
        done += authored
    return done


def test_one_whose_new_session_is_told_ticks_after_the_end_of_the_old_keeps_its_ball(players, world):
    before = world.players
    players.depart("ana", "s1", world.tick)
    assert run(players, world, RATE // 2) == []
    players.arrive("ana", "s1")
    assert run(players, world, 3 * RATE) == []
    assert world.players == before


def test_one_that_does_not_come_back_leaves_after_a_second(players, world):
    players.depart("ana", "s1", world.tick)
    assert run(players, world, RATE) == []
    assert [type(one) for one in run(players, world, 1)] == [Leave]
