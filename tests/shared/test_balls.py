"""Balls: arrays that are checked once, then read-only, and compared bit by bit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import kuglice as kg

finite = st.floats(allow_nan=False, allow_infinity=False)
positive = st.floats(min_value=5e-324, allow_nan=False, allow_infinity=False)


@st.composite
def any_balls(draw):
    count = draw(st.integers(0, 5))
    pairs = arrays.arrays(float, (count, 2), elements=finite)
    masses = st.one_of(positive, st.just(np.inf))
    return kg.Balls(
        position=draw(pairs),
        velocity=draw(pairs),
        radius=draw(arrays.arrays(float, count, elements=positive)),
        mass=draw(arrays.arrays(float, count, elements=masses)),
    )


def test_scalars_and_single_rows_are_broadcast():
    balls = kg.Balls(position=[(1, 2), (3, 4)], velocity=(5, 6), radius=0.5, mass=2)
    assert balls.velocity.tolist() == [[5.0, 6.0], [5.0, 6.0]]
    assert balls.radius.tolist() == [0.5, 0.5]
    assert balls.mass.tolist() == [2.0, 2.0]
    assert balls.position.dtype == np.float64


def test_balls_rest_unless_told_and_have_the_mass_of_their_area():
    balls = kg.Balls(position=[(1, 2)], radius=2)
    assert balls.velocity.tolist() == [[0.0, 0.0]]
    assert balls.mass.tolist() == [3.141592653589793 * 2.0 * 2.0]


def test_arrays_are_copies_and_read_only():
    position = np.array([(1.0, 2.0)])
    balls = kg.Balls(position=position, radius=1)
    position[0] = 9.0
    assert balls.position.tolist() == [[1.0, 2.0]]
    with pytest.raises(ValueError, match="read-only"):
        balls.position[0] = 9.0
    with pytest.raises(AttributeError):
        balls.position = position


@given(any_balls(), any_balls())
def test_concatenation_keeps_order_and_bits(first, second):
    whole = first + second
    assert len(whole) == len(first) + len(second)
    assert whole[: len(first)] == first
    assert whole[len(first) :] == second


@given(any_balls())
def test_a_message_keeps_every_bit(balls):
    message = balls.to_message()
    again = kg.Balls.from_message(message)
    assert again == balls
    assert again.to_message() == message


def test_a_negative_zero_is_another_state():
    assert kg.Balls(position=[(0.0, 0.0)], radius=1) != kg.Balls(position=[(-0.0, 0.0)], radius=1)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"position": [(1, 2, 3)], "radius": 1}, r"position = 'shape \(1, 3\)': must have shape \(1, 2\)"),
        ({"position": [3, 1], "radius": 1}, r"position = 'shape \(2,\)': must have shape \(n, 2\)"),
        ({"position": 3, "radius": 1}, r"position = 'shape \(\)': must have shape \(n, 2\)"),
        ({"position": [[(1, 2)]], "radius": 1}, r"position = 'shape \(1, 1, 2\)': must have shape \(n, 2\)"),
        ({"position": [(1, 2)], "radius": [1, 2]}, r"radius = 'shape \(2,\)': must have shape \(1,\)"),
        ({"position": [(1, 2), (3,)], "radius": 1}, "position = .*rows of equal length"),
        ({"position": [("1", "2")], "radius": 1}, "position = .*must be numbers"),
        ({"position": [(1, np.nan)], "radius": 1}, r"position\[0\]\[1\] = nan: must be finite"),
        ({"position": [(1, 2)], "velocity": (0, np.inf), "radius": 1}, r"velocity\[0\]\[1\] = inf"),
        ({"position": [(1, 2)], "radius": 0}, r"radius\[0\] = 0.0: must be finite and greater than 0"),
        ({"position": [(1, 2)], "radius": np.inf}, r"radius\[0\] = inf"),
        ({"position": [(1, 2)], "radius": True}, "radius = True: must be numbers"),
        ({"position": [(1, 2)], "radius": 1, "mass": -1}, r"mass\[0\] = -1.0: must be greater than 0"),
        ({"position": [(1, 2)], "radius": 1, "mass": np.nan}, r"mass\[0\] = nan"),
    ],
)
def test_wrong_numbers_are_named(given, told):
    with pytest.raises(kg.errors.SceneError, match=told):
        kg.Balls(**given)


def test_many_wrong_values_are_counted_not_listed():
    with pytest.raises(kg.errors.SceneError, match="995 more values") as caught:
        kg.Balls(position=np.full((500, 2), np.nan), radius=1)
    assert len(caught.value.problems) == 6


@pytest.mark.parametrize(
    "message",
    [
        {},
        {"position": b"", "velocity": b"", "radius": b"", "mass": "text"},
        {"position": b"1234567", "velocity": b"", "radius": b"", "mass": b""},
        {"position": bytes(8), "velocity": bytes(8), "radius": bytes(8), "mass": bytes(8)},
        {"position": bytes(16), "velocity": bytes(16), "radius": bytes(8), "mass": bytes(16)},
    ],
)
def test_a_wrong_message_is_refused(message):
    with pytest.raises(kg.errors.SceneError):
        kg.Balls.from_message(message)
