"""Inputs: records and messages keep every bit, and each bound of the scene is checked by name."""

import inspect
import math

import msgpack
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from kuglice import _core, inputs
from kuglice.inputs.record import NUMBERS

number = st.floats(allow_nan=False, allow_infinity=False)
above = st.floats(min_value=0, exclude_min=True, allow_infinity=False)
sent = {"client": st.integers(0, 2**32 - 1), "sequence": st.integers(0, 2**64 - 1)}
ball = st.integers(0, 2**64 - 2)

any_input = st.one_of(
    st.builds(kg.Join, x=number, y=number, radius=above, mass=above, **sent),
    st.builds(kg.Join, **sent),
    st.builds(kg.Leave, **sent),
    st.builds(kg.Spawn, x=number, y=number, vx=number, vy=number, radius=above, mass=above, **sent),
    st.builds(kg.Remove, ball=ball, **sent),
    st.builds(kg.Thrust, x=number, y=number, **sent),
    st.builds(kg.Attract, x=number, y=number, strength=number, **sent),
    st.builds(kg.Kick, ball=st.none() | ball, vx=number, vy=number, **sent),
)

SCENE = kg.Scene(
    box=(0, 0, 20, 10),
    balls=kg.Balls(position=[(5, 5), (10, 5)], radius=1, mass=[2, math.inf]),
    forces=[kg.ThrustForce(), kg.AttractForce(softening=1)],
    limits=kg.InputLimits(
        thrust=10,
        attract=20,
        kick=3,
        spawn=kg.SpawnLimits(max_radius=1, max_mass=4, max_speed=5),
        remove=True,
        max_balls=5,
    ),
    players=kg.PlayerRules(radius=0.5, mass=1, spawn_points=[(2, 2), (18, 8)], max_players=2),
)


@pytest.fixture
def world() -> kg.World:
    """Client 1 owns a ball, client 2 owns another."""
    made = kg.World(SCENE)
    for client in (1, 2):
        made.step([inputs.join(SCENE, made, client)])
    return made


def own(world: kg.World, client: int) -> int:
    return dict(world.players)[client]


def test_the_kinds_are_those_of_the_core():
    kinds = tuple(kind.model_fields["kind"].default for kind in inputs.KINDS)
    assert kinds == _core.INPUT_KINDS


@given(st.lists(any_input, max_size=5))
def test_records_keep_every_bit(given_inputs):
    records = inputs.pack(given_inputs)
    assert len(records) == len(given_inputs) * _core.INPUT_BYTES
    again = inputs.unpack(records)
    assert again == given_inputs
    assert inputs.pack(again) == records


@given(any_input)
def test_messages_keep_every_bit(given_input):
    wire = msgpack.packb(inputs.to_message(given_input))
    again = inputs.from_message(msgpack.unpackb(wire))
    assert again == given_input
    assert inputs.pack([again]) == inputs.pack([given_input])


@given(st.binary(max_size=2 * 69))
def test_arbitrary_bytes_are_inputs_or_an_error(data):
    try:
        read = inputs.unpack(data)
    except kg.errors.InputError:
        return
    assert inputs.pack(read) == data


@pytest.mark.parametrize(
    ("message", "told"),
    [
        ({}, "input"),
        ({"kind": "jump"}, "jump"),
        ({"kind": "thrust", "x": 1}, "thrust.y: missing"),
        ({"kind": "thrust", "x": 1, "y": math.nan}, "thrust.y = nan: must be a finite number"),
        ({"kind": "thrust", "x": 1, "y": "2"}, "thrust.y = '2'"),
        ({"kind": "thrust", "x": 1, "y": 2, "z": 3}, "thrust.z = 3: no such key"),
        ({"kind": "thrust", "x": 1, "y": 2, "client": 2**32}, "thrust.client = 4294967296"),
        ({"kind": "thrust", "x": 1, "y": 2, "client": -1}, "thrust.client = -1"),
        ({"kind": "thrust", "x": 1, "y": 2, "sequence": 2**64}, "thrust.sequence"),
        ({"kind": "spawn", "x": 1, "y": 2, "radius": 0, "mass": 1}, "spawn.radius = 0"),
        ({"kind": "spawn", "x": 1, "y": 2, "radius": 1, "mass": math.inf}, "spawn.mass = inf"),
        ({"kind": "kick", "vx": 1, "vy": 0, "ball": 2**64 - 1}, "kick.ball"),
        (None, "input"),
        (7, "input"),
        ([1, 2], "input"),
    ],
)
def test_a_wrong_message_is_refused_by_name(message, told):
    with pytest.raises(kg.errors.InputError, match=told):
        inputs.from_message(message)


def test_a_wrong_argument_is_refused_by_name():
    with pytest.raises(kg.errors.InputError, match="Kick: vx = nan"):
        kg.Kick(vx=math.nan, vy=0)


def test_allowed_inputs_pass(world):
    for given_input in (
        kg.Thrust(client=1, x=6, y=8),
        kg.Attract(client=1, x=20, y=10, strength=-20),
        kg.Kick(client=1, vx=0, vy=3),
        kg.Kick(client=1, ball=int(world.id[0]), vx=0, vy=3),
        kg.Spawn(client=1, x=1, y=9, radius=1, mass=4, vx=3, vy=4),
        kg.Remove(client=1, ball=int(world.id[0])),
        kg.Remove(client=1, ball=own(world, 1)),
        kg.Leave(client=1),
    ):
        inputs.check(given_input, SCENE, world)


@pytest.mark.parametrize(
    ("given_input", "told"),
    [
        (kg.Thrust(client=1, sequence=9, x=6, y=8.1), "thrust 9 of client 1: force 10.08.., at most 10"),
        (kg.Thrust(client=3, x=1, y=0), "the client owns no ball"),
        (kg.Attract(client=1, x=1, y=1, strength=21), "strength 21, at most 20"),
        (kg.Attract(client=1, x=21, y=1, strength=1), "outside the box"),
        (kg.Kick(client=1, vx=4, vy=0), "change of speed 4, at most 3"),
        (kg.Kick(client=3, vx=1, vy=0), "owns no ball and names none"),
        (kg.Kick(client=1, ball=999, vx=1, vy=0), "there is no ball 999"),
        (kg.Spawn(client=1, x=5, y=5, radius=1.5, mass=1), "radius 1.5, at most 1"),
        (kg.Spawn(client=1, x=5, y=5, radius=1, mass=5), "mass 5, at most 4"),
        (kg.Spawn(client=1, x=5, y=5, radius=1, mass=1, vx=6), "speed 6, at most 5"),
        (kg.Spawn(client=1, x=0.5, y=5, radius=1, mass=1), "outside the box"),
        (kg.Remove(client=1, ball=999), "there is no ball 999"),
    ],
)
def test_a_bound_of_the_scene_is_named(world, given_input, told):
    with pytest.raises(kg.errors.InputError, match=told):
        inputs.check(given_input, SCENE, world)


def test_balls_of_others_and_pegs_are_out_of_reach(world):
    theirs, peg = own(world, 2), int(world.id[1])
    with pytest.raises(kg.errors.InputError, match="belongs to client 2"):
        inputs.check(kg.Kick(client=1, ball=theirs, vx=1, vy=0), SCENE, world)
    with pytest.raises(kg.errors.InputError, match="belongs to client 2"):
        inputs.check(kg.Remove(client=1, ball=theirs), SCENE, world)
    with pytest.raises(kg.errors.InputError, match="infinite mass"):
        inputs.check(kg.Kick(client=1, ball=peg, vx=1, vy=0), SCENE, world)


def test_spawns_end_at_the_largest_number_of_balls(world):
    spawn = kg.Spawn(client=1, x=1, y=9, radius=0.2, mass=1)
    inputs.check(spawn, SCENE, world)
    world.step([spawn])
    with pytest.raises(kg.errors.InputError, match="5 balls, at most 5"):
        inputs.check(spawn, SCENE, world)


def test_a_scene_without_limits_refuses_every_kind(world):
    closed = SCENE.model_copy(update={"limits": kg.InputLimits()})
    first = int(world.id[0])
    for given_input in (
        kg.Thrust(client=1, x=0, y=0),
        kg.Attract(client=1, x=1, y=1, strength=0),
        kg.Kick(client=1, vx=0, vy=0),
        kg.Spawn(client=1, x=5, y=5, radius=1, mass=1),
        kg.Remove(client=1, ball=first),
    ):
        with pytest.raises(kg.errors.InputError, match=f"the scene allows no {given_input.kind}"):
            inputs.check(given_input, closed, world)


def test_the_owner_is_held_to_what_is_possible_only(world):
    inputs.check(kg.Kick(ball=int(world.id[0]), vx=1000, vy=0), SCENE, world)
    inputs.check(kg.Spawn(x=5, y=5, radius=3, mass=1000), SCENE, world)
    with pytest.raises(kg.errors.InputError, match="there is no ball"):
        inputs.check(kg.Kick(ball=999, vx=1, vy=0), SCENE, world)


def test_players_get_the_roomiest_spawn_point_until_the_scene_is_full():
    world = kg.World(SCENE)
    first = inputs.join(SCENE, world, 1)
    assert (first.x, first.y) == (18.0, 8.0)
    assert (first.radius, first.mass) == (0.5, 1.0)
    world.step([first])
    second = inputs.join(SCENE, world, 2)
    assert (second.x, second.y) == (2.0, 2.0)
    world.step([second])
    with pytest.raises(kg.errors.InputError, match="client 3 refused at 2 players, at most 2"):
        inputs.join(SCENE, world, 3)
    with pytest.raises(kg.errors.InputError, match="client 2 has joined already"):
        inputs.join(SCENE, world, 2)


def crowd(blocking, **rules):
    """The scene with balls of radius 1 at these places."""
    balls = kg.Balls(position=blocking, radius=1, mass=1)
    players = SCENE.players.model_copy(update=rules)
    limits = SCENE.limits.model_copy(update={"max_balls": len(blocking) + 1})
    changes = {"balls": balls, "players": players, "limits": limits, "allow_overlap": True}
    return kg.World(SCENE.model_copy(update=changes))


@given(st.lists(st.tuples(st.floats(1, 19), st.floats(1, 9)), max_size=6))
def test_a_player_appears_inside_no_ball_while_there_is_room(others):
    # Whatever else there is: both spawn points are blocked, and 8 balls leave room in a box of 20 by 10.
    world = crowd([(2, 2), (18, 8), *others])
    joined = inputs.join(world.scene, world, 1)
    assert inputs.join(world.scene, world, 1) == joined
    assert 0.5 <= joined.x <= 19.5
    assert 0.5 <= joined.y <= 9.5
    for x, y in world.position:
        assert math.hypot(joined.x - x, joined.y - y) >= 1.5 - 1e-12


def test_a_player_without_room_at_the_spawn_points_appears_close_to_one():
    world = crowd([(2, 2), (18, 8)])
    joined = inputs.join(world.scene, world, 1)
    assert min(math.hypot(joined.x - x, joined.y - y) for x, y in world.position) < 1.5 + 0.25


def test_in_a_full_box_a_player_gets_the_roomiest_spawn_point():
    world = crowd(
        [(1 + 2 * i, 1 + 2 * j) for i in range(10) for j in range(5)], spawn_points=[(1, 1), (4, 4)]
    )
    joined = inputs.join(world.scene, world, 1)
    assert (joined.x, joined.y) == (4.0, 4.0)


def test_a_scene_without_player_rules_gives_no_ball():
    world = kg.World(kg.scenes.cradle())
    world.step([inputs.join(world.scene, world, 4)])
    assert world.players == [(4, None)]
    assert world.count == 6


def test_signatures_are_readable():
    assert str(inspect.signature(kg.Thrust)) == (
        "(*, client: int = 0, sequence: int = 0, kind: Literal['thrust'] = 'thrust', x: float, y: float)"
    )
    assert str(inspect.signature(kg.Gravity)).startswith("(x: float, y: float, *")
    assert "Validator" not in str(inspect.signature(kg.Scene))


@given(
    st.sampled_from(["thrust", "kick", "attract"]),
    st.floats(-20, 20, allow_subnormal=True),
    st.floats(-20, 20),
    st.floats(-20, 20),
)
def test_rounded_numbers_take_two_bytes_and_stay_within_their_bounds(kind, x, y, strength):
    left, bottom, right, top = SCENE.box
    exact = {
        "thrust": kg.Thrust(client=3, sequence=9, x=x, y=y),
        "kick": kg.Kick(client=3, sequence=9, ball=4, vx=x, vy=y),
        "attract": kg.Attract(
            client=3,
            sequence=9,
            x=min(max(x, left), right),
            y=min(max(y, bottom), top),
            strength=strength,
        ),
    }[kind]
    less = inputs.rounded(exact, SCENE)
    assert (less.kind, less.client, less.sequence) == (exact.kind, exact.client, exact.sequence)
    assert inputs.rounded(less, SCENE) == less
    for name in NUMBERS[kind]:
        was, now = getattr(exact, name), getattr(less, name)
        assert float(np.float16(now)) == now
        assert abs(now - was) <= max(abs(was) / 1024, 2**-24)
        if kind == "attract" and name in "xy":
            assert (left, bottom)["xy".index(name)] <= now <= (right, top)["xy".index(name)]
        else:
            assert abs(now) <= abs(was)


def test_a_spawn_is_not_rounded():
    spawn = kg.Spawn(x=0.1, y=0.1, radius=0.1, mass=0.1)
    assert inputs.rounded(spawn, SCENE) == spawn


def test_what_two_bytes_cannot_hold_stays_exact():
    far = kg.Thrust(x=1e9, y=-1e9)
    assert inputs.rounded(far, SCENE) == far
    narrow = kg.Scene(box=(1000.01, 1000.01, 1000.02, 1000.02))
    point = kg.Attract(x=1000.01, y=1000.02, strength=1.0)
    assert inputs.rounded(point, narrow) == point
