"""Regression: copy_from took the state and the rules of any world, and kept saying its own model and scene.

After `a.copy_from(b)` of a world with another model, `a.model` named what neither computed, and `a.scene` had the box
of before. What can be computed by both is copied; the rest is refused, and leaves the world as it was.
"""

from __future__ import annotations

import pytest

import kuglice as kg
from kuglice.errors import ModelError, SceneError

SCENE = kg.scenes.gas(n=20)


def run(scene: kg.Scene = SCENE, **model: object) -> kg.World:
    world = kg.World(scene, kg.Model(**model))
    world.run(3)
    return world


@pytest.mark.parametrize(
    ("part", "value"),
    [
        ("contacts", "event"),
        ("integrator", "rk4"),
        ("substeps", 2),
        ("broadphase", "brute"),
        ("smallest_node", 2.0),
    ],
)
def test_of_another_model_is_refused(part, value):
    here, other = run(), run(**{part: value})
    before = here.state_hash
    with pytest.raises(ModelError, match=f"copy_from: {part} of the other world is .*{value}.*clone"):
        here.copy_from(other)
    assert here.state_hash == before


@pytest.mark.parametrize(
    ("part", "value"),
    [
        ("box", (0.0, 0.0, 90.0, 90.0)),
        ("restitution", 0.5),
        ("tick_rate", 30.0),
        ("walls", False),
        ("forces", (kg.Gravity(0.0, -1.0),)),
    ],
)
def test_of_another_scene_is_refused(part, value):
    here = run()
    other = run(kg.Scene(**{"box": SCENE.box, "balls": SCENE.balls, part: value}))
    before = here.state_hash
    with pytest.raises(SceneError, match=f"copy_from: .* differs in its {part}"):
        here.copy_from(other)
    assert here.state_hash == before


def test_of_other_balls_is_refused():
    with pytest.raises(SceneError, match="differs in its balls"):
        run().copy_from(run(kg.Scene(box=SCENE.box, balls=SCENE.balls[:5])))


def test_of_an_equal_scene_and_model_is_a_copy():
    """The planner's sentences and a scene's title make no difference to a step."""
    here = run()
    other = kg.World(
        kg.Scene(box=SCENE.box, balls=SCENE.balls, title="alike"), kg.Model(reasons=("because.",))
    )
    other.run(9)
    here.copy_from(other)
    here.run(5)
    other.run(5)
    assert here.state_hash == other.state_hash
