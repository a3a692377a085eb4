"""A world of some of the balls: it is the same step, and what is known better is put right in place."""

import numpy as np
import pytest

import kuglice as kg
from kuglice.errors import InputError, LentError, SceneError


def states_of(world: kg.World, chosen: slice = slice(None)) -> kg.BallStates:
    everything = (world.id, world.position, world.velocity, world.radius, world.mass)
    return kg.BallStates(*(values[chosen] for values in everything))


@pytest.mark.parametrize("contacts", kg._core.CONTACTS)
def test_all_balls_of_a_world_go_on_as_that_world_does(contacts):
    scene = kg.scenes.rain(n=300)
    world = kg.World(scene, kg.Model(contacts=contacts))
    world.run(40)
    view = kg.World.with_balls(scene, world.tick, states_of(world), world.model)
    for one in (world, view):
        one.run(40)
    assert view.tick == world.tick == 80
    assert view.position.tobytes() == world.position.tobytes()
    assert view.velocity.tobytes() == world.velocity.tobytes()


def test_what_is_known_better_is_put_right_and_who_left_is_taken_out():
    world = kg.World(kg.scenes.gas(n=50))
    view = kg.World.with_balls(world.scene, 0, states_of(world, slice(0, 40)))
    world.run(5)
    view.replace([0, 1, 2, 999], states_of(world, slice(2, 50)))
    assert view.id.tolist() == list(range(2, 50))
    assert (view.position == world.position[2:]).all()
    view.replace([], kg.BallStates.none())
    assert view.count == 48


def test_no_balls_are_a_world_too():
    view = kg.World.with_balls(kg.scenes.gas(n=50), 7, kg.BallStates.none())
    view.step()
    assert (view.tick, view.count) == (8, 0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"id": [3, 3]}, "ball 3 is given after ball 3: ids must ascend"),
        ({"id": [3, 2]}, "ball 2 is given after ball 3: ids must ascend"),
        ({"id": [-1, 2]}, "must be a row of whole numbers, 0 or above"),
        ({"id": [0.5, 2.0]}, "must be a row of whole numbers, 0 or above"),
        ({"id": np.array([1, 2**64 - 1], np.uint64)}, "stands for no ball"),
        ({"id": [1]}, "id has 1 numbers, it must have 2"),
        ({"position": [[1, 1], [np.nan, 1]]}, "ball 2: a ball's position"),
        ({"velocity": [[1, 1], [np.inf, 1]]}, "ball 2: a ball's position"),
        ({"position": [[1, 1]]}, r"position has shape \[1, 2\], it must be \[2, 2\]"),
        ({"position": [1, 2, 3]}, "states of balls"),
        ({"radius": [0.5, 0.0]}, "ball 2: a ball's radius is 0, it must be above 0"),
        ({"radius": [0.5, -1.0]}, "ball 2: a ball's radius is -1"),
        ({"mass": [1.0, np.nan]}, "ball 2: a ball's mass is NaN"),
        ({"mass": ["x", "y"]}, "states of balls"),
    ],
)
def test_what_cannot_be_known_of_balls_is_refused_and_changes_nothing(change, words):
    scene = kg.scenes.gas(n=50)
    good = kg.BallStates([1, 2], [[1, 1], [5, 5]], [[0, 0], [1, 0]], [0.5, 0.5], [1.0, np.inf])
    view = kg.World.with_balls(scene, 0, good)
    before = view.snapshot()
    with pytest.raises(SceneError, match=words):
        view.replace([], good._replace(**change))
    with pytest.raises(SceneError, match=words):
        kg.World.with_balls(scene, 0, good._replace(**change))
    assert view.snapshot() == before


def test_lent_worlds_are_not_put_right():
    world = kg.World(kg.scenes.gas(n=50))
    with world.view(), pytest.raises(LentError):
        world.replace([1], kg.BallStates.none())


def test_who_plays_and_what_is_held_can_be_told():
    scene = kg.scenes.arena()
    world = kg.World(scene)
    world.step(
        [kg.Join(client=1, x=8.0, y=4.5, radius=0.4, mass=1.0), kg.Attract(client=1, x=3, y=3, strength=9)]
    )
    view = kg.World.with_balls(scene, world.tick, states_of(world), world.model)
    view.hold(world.players, world.held)
    assert (view.players, view.held) == (world.players, world.held)
    for one in (world, view):
        one.run(30)
    assert view.position.tobytes() == world.position.tobytes()
    with pytest.raises(InputError, match="held input of kind"):
        view.hold([], [(1, "push", 0.0, 0.0, 0.0)])
    with pytest.raises(InputError, match="must ascend by client"):
        view.hold([(2, None), (1, None)], [])
