"""A scene as a message: msgpack and back with every bit, and nothing but valid scenes come back."""

import msgpack
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg

number = st.floats(-1e6, 1e6)


@st.composite
def any_scene(draw):
    count = draw(st.integers(0, 4))
    position = [(2.5 + 5 * k, draw(st.floats(1, 9))) for k in range(count)]
    forces = st.lists(
        st.one_of(
            st.builds(kg.Gravity, number, number),
            st.builds(kg.Drag, st.floats(0, 10)),
            st.builds(kg.Attractor, number, number, number, st.floats(0.1, 10)),
            st.builds(kg.Spring, number, number, st.floats(0, 10)),
            st.just(kg.ThrustForce()),
        ),
        max_size=3,
    )
    return kg.Scene(
        title=draw(st.text(max_size=10)),
        box=(0, 0, 20, 10),
        walls=draw(st.booleans()),
        restitution=draw(st.floats(0, 1)),
        tick_rate=draw(st.floats(1, 1000)),
        balls=kg.Balls(
            position=position,
            velocity=[(draw(number), draw(number)) for _ in range(count)],
            radius=draw(st.floats(0.01, 1)),
        )
        if count
        else kg.Balls.none(),
        forces=draw(forces),
        model=kg.ModelPins(substeps=draw(st.none() | st.integers(1, 9))),
        accuracy=draw(st.sampled_from(["visual", "faithful", "exact", 0.01])),
        budget_ms=draw(st.none() | st.floats(0.1, 100)),
        limits=kg.InputLimits(kick=draw(st.none() | st.floats(0.1, 10)), remove=draw(st.booleans())),
    )


@given(any_scene())
def test_a_message_keeps_every_bit(scene):
    wire = msgpack.packb(scene.to_message())
    again = kg.Scene.from_message(msgpack.unpackb(wire))
    assert again == scene
    assert again.balls == scene.balls
    assert again.rules().to_bytes() == scene.rules().to_bytes()
    assert msgpack.packb(again.to_message()) == wire


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_every_built_in_scene_travels(name):
    scene = kg.scenes.TABLE[name]()
    again = kg.Scene.from_message(msgpack.unpackb(msgpack.packb(scene.to_message())))
    assert again.balls == scene.balls
    assert kg.World(again).state_hash == kg.World(scene).state_hash


@pytest.mark.parametrize(
    "change",
    [
        {"box": None},
        {"box": [0, 0, 1e400, 1]},
        {"balls": {"position": b"123"}},
        {"balls": b""},
        {"forces": [1]},
        {"limits": None},
        {"more": 1},
        {"restitution": 2.0},
    ],
)
def test_a_changed_message_is_refused(change):
    message = kg.scenes.cradle().to_message() | change
    with pytest.raises(kg.errors.SceneError):
        kg.Scene.from_message(message)


@pytest.mark.parametrize("message", [None, 5, [], b"", {}, {1: 2}])
def test_what_is_no_scene_is_refused(message):
    with pytest.raises(kg.errors.SceneError):
        kg.Scene.from_message(message)
