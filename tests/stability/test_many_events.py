"""A tick may hold a million collisions of one pair; beyond the limit comes an error that loses nothing."""

from __future__ import annotations

import math
import re

import pytest

import kuglice as kg
from kuglice.errors import EventLimitError
from stability.worlds import make

LIMIT = 4_000_000
"""Documented at kuglice_step::contacts::EVENT_LIMIT."""


def billiard(ratio: float) -> kg.World:
    """Galperin's (see test_mass_ratio): a light ball between a wall and a heavy one, all within one tick."""
    return make(
        [[1.0, 5.0], [3.0, 5.0]],
        [[0.0, 0.0], [-1.0, 0.0]],
        mass=[1.0, ratio],
        box=(0, 0, 100, 10),
        tick_rate=0.1,
    )


def test_a_million_collisions_of_one_pair_in_one_tick():
    # floor(pi 10^6) hits, every other one of the pair.
    world = billiard(1e12)
    energy = world.energy
    world.step()
    assert world.collisions + world.wall_hits == 3_141_592
    assert world.collisions == 1_570_796
    assert world.energy == pytest.approx(energy, rel=1e-9)


def test_a_hundred_thousand_hops_on_a_peg_in_one_tick():
    # A ball at height d above a peg hops every 2 sqrt(2 d / g) seconds, the first time after half of that.
    d, gravity, duration = 1e-6, 10.0, 90.0
    world = make([[0.0, 0.0], [0.0, 1.0 + d]], mass=[math.inf, 1.0], forces=[kg.Gravity(0.0, -gravity)])
    d = world.position[1, 1] - 1.0
    energy = world.energy
    world.step(dt=duration)
    assert world.collisions == pytest.approx(duration / (2 * math.sqrt(2 * d / gravity)) + 0.5, abs=2)
    assert world.energy == pytest.approx(energy, abs=1e-13)


def assert_refused(world: kg.World, message: str, inputs: list[kg.Input] | tuple[()] = ()) -> None:
    """A tick raises the limit, says where, and leaves no trace."""
    before = (world.tick, world.time, world.collisions, world.wall_hits, world.state_hash, world.snapshot())
    with pytest.raises(EventLimitError) as caught:
        world.step(inputs)
    found = re.search(message, str(caught.value))
    assert found, str(caught.value)
    assert str(LIMIT) in str(caught.value)
    assert 0 <= float(found["time"]) <= 1 / world.scene.tick_rate
    after = (world.tick, world.time, world.collisions, world.wall_hits, world.state_hash, world.snapshot())
    assert before == after


def test_beyond_the_limit_the_error_names_the_pair_and_the_time():
    # floor(pi 10^7) hits; the pair meets for the first time after 1 s, and for the last before 2 s.
    assert_refused(billiard(1e14), r"tick 0: .* balls 0 and 1 (?P<time>1\.\d+) s")


def wedged() -> kg.World:
    """A ball of the width of its box: sideways it would hit both walls for ever, at one time."""
    return make([[0.5, 5.0]], [[0.0, 1.0]], radius=0.5, box=(0, 0, 1, 10), tick_rate=60.0)


@pytest.mark.parametrize("ticks", [0, 7])
def test_the_world_goes_on_without_the_input_that_did_it(ticks):
    world, peer = wedged(), wedged()
    world.run(ticks)
    kick = kg.Kick(client=0, sequence=1, ball=0, vx=1.0, vy=0.0)
    assert_refused(world, rf"tick {ticks}: .* ball 0 and a wall (?P<time>[\de.-]+) s", [kick])
    world.run(60)
    peer.run(ticks + 60)
    assert world.state_hash == peer.state_hash


def test_a_ball_between_closing_pegs_is_refused_not_hung():
    # Pegs give way to nothing and to no peg: the ball's speed and its hits have no end.
    world = make(
        [[-2.0, 0.0], [0.0, 0.0], [2.0, 0.0]],
        [[1.0, 0.0], [0.0, 0.0], [-1.0, 0.0]],
        mass=[math.inf, 1.0, math.inf],
        tick_rate=0.5,
    )
    assert_refused(world, r"tick 0: .* balls (0 and 1|1 and 2) (?P<time>1(\.\d+)?|0\.99\d*) s")
