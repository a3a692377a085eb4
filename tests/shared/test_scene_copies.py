"""Regression: `Scene.model_copy(update=...)` took anything, though a scene promises to be valid.

A tick rate of -60 ran time backwards without a word, and a box of 1 x 1 around a gas of 30 x 30 had every ball outside.
"""

from __future__ import annotations

import pytest

import kuglice as kg
from kuglice.errors import SceneError
from kuglice.layout import RandomGroup

GAS = kg.scenes.gas(n=20)


@pytest.mark.parametrize(
    ("update", "message"),
    [
        ({"tick_rate": -60.0}, "tick_rate"),
        ({"restitution": 2.0}, "restitution"),
        ({"box": (0.0, 0.0, 1.0, 1.0)}, "does not fit"),
        ({"tick_rte": 60.0}, "tick_rate"),
        ({"balls": kg.Balls(position=[(900.0, 1.0)], radius=0.5)}, "balls"),
        ({"balls": kg.Balls(position=[(3, 3), (3.5, 3)], radius=0.5)}, "overlap"),
    ],
)
def test_a_copy_is_validated(update, message):
    with pytest.raises(SceneError, match=message):
        GAS.model_copy(update=update)


def test_a_copy_keeps_what_is_not_changed():
    copy = GAS.model_copy(update={"tick_rate": 120.0})
    assert copy.tick_rate == 120.0
    assert copy.groups == GAS.groups
    assert copy.balls == GAS.balls
    assert copy == kg.Scene(**{**dict(GAS), "tick_rate": 120.0})


def test_groups_are_placed_again_where_they_or_the_box_change():
    other = GAS.model_copy(update={"groups": (RandomGroup(count=7, radius=0.5),)})
    assert len(other.balls) == 7
    wider = GAS.model_copy(update={"box": (0.0, 0.0, 90.0, 90.0)})
    assert wider.balls != GAS.balls
    assert wider.groups == GAS.groups


def test_balls_replace_groups_and_no_groups_leave_the_balls():
    one = GAS.model_copy(update={"balls": GAS.balls[:1]})
    assert len(one.balls) == 1
    assert one.groups == ()
    alone = GAS.model_copy(update={"groups": ()})
    assert alone.balls == GAS.balls


def test_a_copy_without_changes_is_equal():
    assert GAS.model_copy() == GAS
