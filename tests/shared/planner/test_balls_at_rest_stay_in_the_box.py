"""Regression: without a pin, the planner chose contacts under which balls that come to rest fall through the floor.

`overlap` and `backtrack` turn a velocity round at a wall and leave the place, so that a ball which has lost its
bounce sinks on, a little per step. The planner looked for a crowd, and at that only below visual accuracy: one ball
of restitution 0.5 under gravity was given `backtrack` and lay with its centre under the floor some minutes later, a
hundred balls within 40 s.
"""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from kuglice.errors import PlanError
from kuglice.layout import RandomGroup
from kuglice.planner import expect

MINUTE = 60.0
BOX = (0.0, 0.0, 40.0, 20.0)
DOWN = kg.Gravity(0.0, -10.0)
ONE = {"balls": kg.Balls(position=[(2, 3)], radius=0.5, mass=1.0)}
SOME = {"balls": kg.Balls(position=[(2 + 3 * k, 3) for k in range(9)], radius=0.5, mass=1.0)}
MANY = {"groups": (RandomGroup(count=30, radius=0.3, speed=1.0),)}
SCENES = {
    "one ball under gravity": {**ONE, "forces": (DOWN,), "restitution": 0.5},
    "one that does not bounce": {**ONE, "forces": (DOWN,), "restitution": 0.0},
    "one that loses a little": {**ONE, "forces": (DOWN,), "restitution": 0.9},
    "an elastic one with drag": {**ONE, "forces": (DOWN, kg.Drag(0.5)), "restitution": 1.0},
    "one that an attractor holds at a wall": {
        **ONE,
        "forces": (kg.Attractor(2.0, -3.0, 100.0, 1.0),),
        "restitution": 0.5,
    },
    "one that a spring holds at a wall": {**ONE, "forces": (kg.Spring(-3.0, 5.0, 3.0),), "restitution": 0.5},
    "one that is driven off": {**ONE, "forces": (kg.Attractor(9.0, 9.0, -500.0, 1.0),), "restitution": 0.5},
    "some": {**SOME, "forces": (DOWN,), "restitution": 0.5},
    "many": {**MANY, "forces": (DOWN, kg.Drag(0.5)), "restitution": 0.9},
    "elastic ones": {**SOME, "forces": (DOWN,), "restitution": 1.0},
    "elastic ones in short ticks": {**ONE, "forces": (DOWN,), "restitution": 1.0, "tick_rate": 1000.0},
}


def scene_of(name: str) -> kg.Scene:
    return kg.Scene(box=BOX, **SCENES[name])


def centres_outside(world: kg.World) -> int:
    low, high = np.array(BOX[:2]), np.array(BOX[2:])
    return int(((world.position < low) | (world.position > high)).any(axis=1).sum())


@pytest.mark.parametrize("name", SCENES)
def test_no_centre_leaves_the_box_within_a_minute(name):
    scene = scene_of(name)
    world = kg.World(scene)
    world.run(round(MINUTE * scene.tick_rate))
    assert centres_outside(world) == 0, f"{world.model}: {world.position.min(axis=0)}"


@pytest.mark.parametrize("accuracy", ["visual", "faithful", 10.0])
@pytest.mark.parametrize("name", [name for name in SCENES if not name.startswith("elastic ones")])
def test_whatever_may_come_to_rest_is_given_event(name, accuracy):
    scene = scene_of(name).model_copy(update={"accuracy": accuracy})
    assert kg.plan(scene).contacts == "event"


@pytest.mark.parametrize("contacts", ["overlap", "backtrack"])
def test_what_the_planner_avoids_does_leave_the_box(contacts):
    world = kg.World(scene_of("one that does not bounce"), kg.Model(contacts=contacts))
    world.run(round(MINUTE * world.scene.tick_rate))
    assert centres_outside(world) == 1


@pytest.mark.parametrize("contacts", ["overlap", "backtrack"])
def test_elastic_balls_need_an_integrator_that_keeps_their_energy(contacts):
    scene = scene_of("elastic ones in short ticks")
    sinks = {
        name: expect(scene, kg.Model(integrator=name, contacts=contacts)).sinks
        for name in ("euler", "symplectic_euler", "verlet", "rk4")
    }
    assert sinks == {"euler": True, "symplectic_euler": True, "verlet": False, "rk4": False}


def test_pins_that_let_balls_sink_are_told_so():
    scene = scene_of("some").model_copy(update={"model": kg.ModelPins(contacts="overlap")})
    assert any("sink through walls" in reason for reason in kg.plan(scene).reasons)


def test_where_nothing_can_come_to_rest_the_cheaper_contacts_stay():
    places = {"balls": kg.Balls(position=[(2, 3), (30, 15)], radius=0.5)}
    for given in (
        {**places, "restitution": 0.5},
        {**places, "restitution": 0.5, "forces": (DOWN,), "walls": False},
        {**ONE, "restitution": 0.5, "forces": (kg.Spring(20.0, 10.0, 3.0),)},
        {**places, "restitution": 1.0, "forces": (DOWN,)},
    ):
        assert kg.plan(kg.Scene(box=BOX, **given)).contacts != "event", given


def test_a_budget_that_only_sinking_keeps_is_no_plan():
    scene = scene_of("many")
    with pytest.raises(PlanError, match="no registered model meets both"):
        kg.plan(scene.model_copy(update={"budget_ms": expect(scene, kg.plan(scene)).cost_ms / 2}))
