"""Corners and tight boxes: balls that touch two walls, and balls that are large in their box."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from stability.overlaps import beyond_walls
from stability.worlds import make

BOX = (0.0, 0.0, 10.0, 10.0)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("gravity", [(-10.0, -10.0), (0.0, -10.0), (-1.0, -20.0)])
def test_a_ball_pulled_into_a_corner_stays_there(restitution, gravity):
    world = make([[0.5, 0.5]], box=BOX, forces=[kg.Gravity(*gravity)], restitution=restitution)
    world.run(600)
    assert world.position.tolist() == [[0.5, 0.5]]
    assert world.velocity.tolist() == [[0.0, 0.0]]


@pytest.mark.parametrize("contacts", ["overlap", "backtrack", "event"])
@given(angle=st.floats(0.01, math.pi / 2 - 0.01), speed=st.floats(0.1, 1000))
def test_a_ball_shot_into_a_corner_comes_back_the_way_it_went(contacts, angle, speed):
    # Two reflections turn both components: v' = -v.
    direction = np.array([math.cos(angle), math.sin(angle)])
    world = make([[0.5, 0.5]], [-speed * direction], box=BOX, tick_rate=1000 * speed, contacts=contacts)
    world.run(10)
    assert world.wall_hits == 2
    assert world.velocity[0] == pytest.approx(speed * direction, rel=1e-15)


@given(angle=st.floats(0, math.pi / 2), restitution=st.floats(0, 1), heavy=st.floats(0.01, 1e6))
def test_a_ball_wedged_in_a_corner_by_a_heavy_one(angle, restitution, heavy):
    # The small ball is hit by, and between hits thrown back and forth from, two walls and the other ball.
    direction = np.array([math.cos(angle), math.sin(angle)])
    # Where the heavy ball (radius 1) would stick through a wall, it comes along the other.
    start = np.maximum(np.array([0.5, 0.5]) + 2.5 * direction, 1.0)
    velocity = -5.0 * (start - 0.5) / np.linalg.norm(start - 0.5)
    world = make(
        [[0.5, 0.5], start],
        [[0.0, 0.0], velocity],
        radius=[0.5, 1.0],
        mass=[1.0, heavy],
        box=BOX,
        restitution=restitution,
    )
    energy = world.energy
    for _ in range(60):
        world.step()
        assert world.energy <= energy * (1 + 1e-12)
        energy = world.energy
        assert beyond_walls(world) < 1e-9
        assert math.dist(*world.position) > 1.5 - 1e-9
    assert 1 <= world.collisions < 200 * (1 + math.sqrt(heavy))


@pytest.mark.parametrize("contacts", ["overlap", "backtrack", "event"])
def test_a_ball_as_wide_as_its_box_moves_along_it(contacts):
    world = make([[0.5, 5.0]], [[0.0, 3.0]], box=(0, 0, 1, 10), contacts=contacts)
    world.run(600)
    assert world.position[0, 0] == 0.5
    assert abs(world.velocity[0, 1]) == 3.0
    # 30 lengths at one every 9.
    assert world.wall_hits == 3


def roomful(radius: float, contacts: str = "event", broadphase: str = "loose_quadtree") -> kg.World:
    """One large ball amid small ones, all moving; it straddles the middle of any tree."""
    small = 0.15
    grid = np.arange(0.4, 9.8, 0.45)
    place = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
    centre = np.array([5.1, 4.9])
    place = place[np.hypot(*(place - centre).T) > radius + small + 0.01]
    velocity = np.random.default_rng(4).normal(size=(len(place) + 1, 2))
    return make(
        np.concatenate([[centre], place]),
        velocity,
        radius=[radius] + [small] * len(place),
        mass=[(radius / small) ** 2] + [1.0] * len(place),
        box=BOX,
        contacts=contacts,
        broadphase=broadphase,
    )


@pytest.mark.parametrize("radius", [2.6, 3.5, 4.6])
def test_a_ball_larger_than_a_quarter_of_the_box(radius):
    world = roomful(radius)
    energy = world.energy
    for _ in range(60):
        world.run(2)
        assert len(world.overlapping()) == 0
        assert beyond_walls(world) < 1e-12
    assert world.energy == pytest.approx(energy, rel=1e-12)
    assert world.collisions > world.count


@pytest.mark.parametrize("radius", [2.6, 3.5, 4.6])
@pytest.mark.parametrize("contacts", ["overlap", "backtrack", "event"])
def test_no_tree_loses_sight_of_it(radius, contacts):
    brute = roomful(radius, contacts, "brute")
    brute.run(60)
    for broadphase in ("quadtree", "loose_quadtree"):
        world = roomful(radius, contacts, broadphase)
        world.run(60)
        assert world.snapshot() == brute.snapshot(), broadphase


@given(
    restitution=st.sampled_from([0.0, 0.1, 0.5, 0.9]),
    gravity=st.sampled_from([(-7.0, -7.0), (-3.0, -9.0), (-1.0, -20.0)]),
    place=st.tuples(st.floats(0.5, 1.0), st.floats(0.5, 1.0)),
    push=st.tuples(*[st.floats(-2, 2)] * 3),
)
def test_two_balls_that_slide_into_a_corner_stay_in_the_box(restitution, gravity, place, push):
    # On the floor against the side wall and each other: three contacts at rest, struck again and again.
    world = make(
        [[place[0], 0.5], [place[1], 1.6]],
        [[push[0], 0.0], push[1:]],
        box=(0, 0, 5, 5),
        forces=[kg.Gravity(*gravity)],
        restitution=restitution,
    )
    energy = world.energy
    for _ in range(120):
        world.step()
        assert beyond_walls(world) < 1e-9
        assert math.dist(*world.position) > 1 - 1e-9
        assert world.energy <= energy + 1e-9
        energy = world.energy
