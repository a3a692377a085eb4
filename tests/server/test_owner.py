"""Rules of a game act as the owner of the world: in the next tick, held to what is possible, and never in silence."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator

import pytest

from e2e.processes import free_endpoint
from kuglice.errors import InputError, StepError
from kuglice.inputs import Attract, Join, Kick, Leave, Remove, Spawn, Thrust, unpack
from kuglice_server import Server, ServerSettings
from kuglice_server.owner import MAX_WAITING
from server.small_arena import small_arena


@pytest.fixture
def server() -> Iterator[Server]:
    with Server(small_arena(), ServerSettings(world="ruled", listen=(free_endpoint(),))) as made:
        yield made


def ticks(server: Server, count: int) -> None:
    server.run(threading.Event(), seconds=count / server.cadence.rate)


def test_what_it_wants_happens_in_the_next_tick_and_is_told_of(server):
    balls = server.world.count
    given = server.act(Remove(ball=3))
    assert (given.client, given.sequence) == (0, 1)
    assert server.world.count == balls
    ticks(server, 1)
    assert server.world.count == balls - 1
    (told,) = server._history.ticks(0, 1)
    assert unpack(told.inputs) == [given]


def test_it_is_held_to_no_limit_of_the_scene(server):
    server.act(Kick(ball=0, vx=500.0, vy=0.0))
    server.act(Attract(x=10.0, y=5.0, strength=1e3))
    ticks(server, 1)
    assert abs(server.world.velocity).max() > 400


@pytest.mark.parametrize(
    ("given", "why"),
    [
        (Remove(ball=99), "there is no ball 99"),
        (Spawn(x=-5.0, y=5.0, radius=0.1, mass=1.0), "outside the box"),
        (Thrust(x=1.0, y=0.0), "not for the owner of a world"),
        (Join(), "not for the owner of a world"),
        (Leave(), "not for the owner of a world"),
    ],
)
def test_what_is_impossible_is_refused_where_it_is_asked_for(server, given, why):
    with pytest.raises(InputError, match=why):
        server.act(given)
    ticks(server, 1)
    assert server.world.inputs_applied == 0


def test_what_turns_out_impossible_is_left_out_logged_and_counted(server, caplog):
    x, y = server.world.position[0]
    with caplog.at_level(logging.WARNING):
        server.act(Spawn(x=x, y=y, radius=0.1, mass=1.0))
        server.act(Kick(ball=1, vx=1.0, vy=0.0))
        ticks(server, 1)
    assert "spawn 1 of the owner does not act" in caplog.text
    assert server.counters["left_out"] == 1
    assert server.world.inputs_applied == 1


def test_so_many_wait_for_a_tick_and_no_more(server):
    for _ in range(MAX_WAITING):
        server.act(Kick(ball=0, vx=0.01, vy=0.0))
    with pytest.raises(InputError, match=f"{MAX_WAITING} inputs of the owner wait"):
        server.act(Kick(ball=0, vx=0.01, vy=0.0))
    ticks(server, 1)
    server.act(Kick(ball=0, vx=0.01, vy=0.0))


def test_nobody_but_the_server_steps_its_world(server):
    """Its clients would never hear of that tick, and be wrong from there on."""
    ticks(server, 2)
    server.world.step()
    with pytest.raises(StepError, match="at tick 3 instead of 2: only its server may step it"):
        ticks(server, 1)
