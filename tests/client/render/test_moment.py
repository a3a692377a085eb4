"""Moments between two ticks."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from client.render.stages import moment, scene
from kuglice_client.render import HashState, Renderer, between


@given(alpha=st.floats(0, 1), x=st.floats(-100, 100), y=st.floats(-100, 100))
def test_a_ball_is_drawn_on_the_line_between_its_two_places(alpha, x, y):
    drawn = between(moment((1, 2), time=3.0), moment((x, y), time=4.0), alpha)
    assert drawn.position[0] == pytest.approx(np.array([1 + alpha * (x - 1), 2 + alpha * (y - 2)]))
    assert drawn.time == pytest.approx(3 + alpha)


def test_new_balls_are_where_they_are_and_gone_ones_are_not_drawn():
    previous = moment((0, 0), (2, 0), (4, 0), ids=(1, 2, 5))
    current = moment((4, 0), (9, 9), (8, 0), ids=(2, 3, 5))
    drawn = between(previous, current, 0.5)
    assert drawn.id.tolist() == [2, 3, 5]
    assert drawn.position.tolist() == [[3, 0], [9, 9], [6, 0]]


def test_the_states_themselves_are_left_as_they_were():
    previous, current = moment((0, 0), ids=(1,)), moment((4, 0), (5, 5), ids=(1, 2))
    between(previous, current, 0.25)
    assert previous.position.tolist() == [[0, 0]]
    assert current.position.tolist() == [[4, 0], [5, 5]]


def test_looking_at_a_world_copies_it():
    world = kg.World(scene())
    seen = Renderer(world.scene).look(world)
    before = seen.position.copy()
    world.run(10)
    assert (seen.position == before).all()
    assert (seen.position != world.position).any()


def test_looking_takes_what_the_overlays_show_and_no_more():
    world = kg.World(scene())
    bare = Renderer(world.scene).look(world)
    assert bare.nodes is None
    assert bare.hash_state is None
    full = Renderer(world.scene, overlays=("tick", "tree")).look(world)
    assert full.nodes is not None
    assert (full.nodes == world.nodes()).all()
    assert full.hash_state == HashState(world.state_hash, world.tick, "local")


def test_looking_knows_pegs_and_players():
    arena = kg.scenes.find("arena")
    world = kg.World(arena)
    rules = arena.players
    x, y = rules.spawn_points[0]
    world.step([kg.Join(client=3, sequence=1, x=x, y=y, radius=rules.radius, mass=rules.mass)])
    ball = dict(world.players)[3]
    assert Renderer(arena).look(world).players == {ball: 3}
    pegs = kg.World(kg.scenes.find("pegs"))
    fixed = Renderer(pegs.scene).look(pegs).fixed
    assert fixed is not None
    assert (fixed == np.isinf(pegs.mass)).all()
    assert fixed.any()
