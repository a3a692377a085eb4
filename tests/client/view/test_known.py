"""What a view makes of what it is told: the same whenever it comes, exact where it is told everything."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
import pytest

import kuglice as kg
from kuglice import _core
from kuglice_client.view.known import KnownWorld
from kuglice_client.view.told import Told

EVERY = 6
DEPTH = 2
ALL = frozenset(range(4**DEPTH))


class Source:
    """A whole world, and what a server would tell of it, unrounded."""

    def __init__(self, scene: kg.Scene, model: kg.Model | None = None) -> None:
        self.world = kg.World(scene, model)
        packer = _core.Regions(box=scene.box, depth=DEPTH, position_quantum=1, velocity_quantum=1, shapes=[])
        self.node_of = packer.node

    def tell(self, node: int) -> Told:
        world = self.world
        here = self.node_of(world.position) == node
        arrays = (world.id, world.position, world.velocity, world.radius, world.mass)
        return Told(world.tick, node, *(array[here] for array in arrays))

    def known(self, followed=ALL, compare=lambda *_: None) -> KnownWorld:
        made = KnownWorld(
            self.world.scene,
            self.world.model,
            tick=self.world.tick,
            every=EVERY,
            node_of=self.node_of,
            compare=compare,
        )
        made.follow(followed)
        return made

    def run(self, ticks: int, nodes=ALL) -> list[Told]:
        """Everything told in these ticks, in order."""
        told = []
        for _ in range(ticks):
            self.world.step()
            if self.world.tick % EVERY == 0:
                told += [self.tell(node) for node in sorted(nodes)]
        return told


def bits(world: kg.World) -> tuple:
    return world.tick, world.id.tobytes(), world.position.tobytes(), world.velocity.tobytes()


def gas(contacts: str = "overlap") -> Source:
    return Source(kg.scenes.gas(n=400), kg.Model(contacts=contacts))


@pytest.mark.parametrize("contacts", _core.CONTACTS)
def test_told_of_everything_once_it_runs_like_the_whole_world(contacts):
    source = gas(contacts)
    known = source.known()
    for told in [source.tell(node) for node in ALL]:
        assert known.take(told)
    source.run(50)
    known.advance(50)
    assert bits(known.world) == bits(source.world)


def test_what_it_ends_up_with_does_not_depend_on_when_it_was_told():
    source = gas()
    followed = frozenset({0, 1, 2, 3, 6, 12})
    prompt, late, at_once = (source.known(followed) for _ in range(3))
    told = source.run(60, followed)
    shuffled = random.Random(5).sample(told, len(told))
    for tick in range(61):
        prompt.advance(tick)
        for one in told:
            if one.tick == tick:
                prompt.take(one)
    prompt.advance(60)
    late.advance(60)
    for one in shuffled:
        late.take(one)
        if random.Random(one.node).random() < 0.3:
            late.advance(60)
    late.advance(60)
    for one in shuffled:
        at_once.take(one)
    at_once.advance(60)
    assert late.rewinds > 0
    assert prompt.rewinds == 0
    assert bits(prompt.world) == bits(late.world) == bits(at_once.world)
    assert set(prompt.world.id) == set(np.concatenate([one.id for one in told if one.tick == 60]))


def test_the_balls_of_a_tick_are_those_that_were_told_of_it():
    source = gas()
    followed = frozenset({5, 6})
    known = source.known(followed)
    for told in source.run(30, followed):
        known.take(told)
    known.advance(33)
    state = known.at(30)
    here = np.isin(source.node_of(source.world.position), [5, 6])
    assert bits(state) == (
        30,
        source.world.id[here].tobytes(),
        source.world.position[here].tobytes(),
        source.world.velocity[here].tobytes(),
    )
    assert known.told_of(30) == followed
    assert known.at(31) is None
    assert known.world.tick == 33


def one_ball(position: tuple[float, float], velocity: tuple[float, float]) -> Source:
    balls = kg.Balls(position=[position], velocity=[velocity], radius=0.5)
    return Source(kg.Scene(box=(0.0, 0.0, 40.0, 40.0), walls=False, balls=balls))


def test_a_ball_that_left_for_a_region_with_older_news_stays_until_that_one_tells():
    # From node 0 (below 10) to node 1, at 0.25 per tick.
    source = one_ball((9.0, 5.0), (15.0, 0.0))
    known = source.known()
    known.take(source.tell(0))
    known.take(source.tell(1))
    source.run(6)
    known.take(source.tell(0))
    known.advance(6)
    assert known.world.id.tolist() == [0], "node 1 has not told yet"
    known.take(source.tell(1))
    known.advance(6)
    assert known.world.id.tolist() == [0]
    source.world.step([kg.Remove(ball=0)])
    source.run(5)
    known.take(source.tell(0))
    known.advance(12)
    assert known.world.id.tolist() == [0], "it is node 1's ball now"
    known.take(source.tell(1))
    known.advance(12)
    assert known.world.count == 0


def test_a_ball_that_left_for_where_nobody_looks_is_gone():
    source = one_ball((9.0, 5.0), (15.0, 0.0))
    known = source.known({0})
    known.take(source.tell(0))
    source.run(6)
    known.advance(6)
    assert known.world.count == 1
    known.take(source.tell(0))
    known.advance(6)
    assert known.world.count == 0


def test_what_is_followed_no_more_is_forgotten_and_not_heard_of():
    source = gas()
    known = source.known()
    for node in ALL:
        known.take(source.tell(node))
    known.advance(0)
    assert known.world.count == 400
    known.follow({3})
    assert set(known.world.id) == set(source.tell(3).id)
    source.run(6)
    assert not known.take(source.tell(2))
    assert known.take(source.tell(3))
    known.advance(6)
    assert set(source.tell(3).id) <= set(known.world.id)


def test_news_that_is_too_old_or_of_no_region_s_tick_is_counted_and_left():
    source = gas()
    known = source.known()
    first = source.tell(0)
    source.run(7)
    assert not known.take(source.tell(0)), "tick 7 is no multiple of 6"
    known.advance(600)
    assert not known.take(first)
    assert known.too_old == 2
    assert known.world.count == 0


def test_told_twice_counts_once():
    source = gas()
    known = source.known()
    assert known.take(source.tell(0))
    assert not known.take(source.tell(0))


def test_far_behind_it_begins_anew_where_the_server_is():
    source = gas()
    known = source.known()
    source.run(606)
    for node in ALL:
        known.take(source.tell(node))
    known.advance(606)
    assert known.jumps == 1
    assert bits(known.world) == bits(source.world)


def test_predictions_are_compared_with_what_is_told_once():
    source = one_ball((5.0, 5.0), (0.0, 0.0))
    compared = []
    known = source.known({0}, lambda ids, places, off: compared.extend(off.tolist()))
    known.take(source.tell(0))
    known.advance(6)
    assert compared == [], "nothing was thought of it yet"
    source.world.step([kg.Kick(ball=0, vx=6.0, vy=8.0)])
    source.run(5)
    known.advance(20)
    known.take(source.tell(0))
    known.advance(20)
    assert compared == [pytest.approx(2.0)], "a unit away, in radii of a half"
    known.advance(30)
    source.run(6)
    known.take(source.tell(0))
    known.advance(30)
    assert len(compared) == 2


def test_what_others_hold_acts_from_its_tick_on():
    scene = kg.scenes.arena()
    source = Source(scene)
    known = source.known()
    source.world.run(6)
    source.world.step([kg.Attract(client=1, x=8.0, y=4.5, strength=30.0)])
    for _ in range(5):
        source.world.step()
    tick = source.world.tick
    known.advance(20)
    known.hold(tick, source.world.players, source.world.held)
    for node in ALL:
        known.take(source.tell(node))
    known.advance(30)
    source.run(18)
    assert bits(known.world) == bits(source.world)
    assert known.world.held == source.world.held


def test_what_cannot_be_stepped_ends_nothing():
    source = gas()
    known = source.known()
    told = source.tell(0)
    worst = replace(
        told,
        position=np.tile(told.position[0], (23, 1)),
        velocity=np.where(told.velocity > 0, 1.7e308, -1.7e308),
    )
    known.take(worst)
    known.advance(20)
    assert (known.unusable, known.world.count) == (1, 0)
    known.advance(20)
    assert known.world.tick == 20
    source.run(24)
    known.take(source.tell(0))
    known.advance(24)
    assert set(known.world.id) == set(source.tell(0).id)
