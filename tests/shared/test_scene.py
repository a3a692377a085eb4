"""A Scene that exists is a valid one; what is not says key, value and bound, all at once."""

import numpy as np
import pytest

import kuglice as kg

BALLS = kg.Balls(position=[(2, 2), (5, 5)], radius=1)
BOX = (0, 0, 20, 10)


def refused(**given) -> tuple[str, ...]:
    with pytest.raises(kg.errors.SceneError) as caught:
        kg.Scene(**{"box": BOX, "balls": BALLS, **given})
    for problem in caught.value.problems:
        assert problem in str(caught.value)
    return caught.value.problems


def test_the_scene_of_the_readme():
    position = np.array([(3.0, 4.0), (10.0, 5.0)])
    scene = kg.Scene(
        box=(0, 0, 20, 10),
        balls=kg.Balls(position=position, velocity=position, radius=np.ones(2), mass=np.ones(2)),
        forces=[kg.Gravity(0, -10)],
        restitution=1.0,
        tick_rate=60,
    )
    assert scene.forces[0].y == -10.0
    assert scene.walls
    assert len(scene.balls) == 2


def test_a_scene_cannot_be_changed():
    scene = kg.Scene(box=BOX, balls=BALLS)
    with pytest.raises(ValueError, match="frozen"):
        scene.restitution = 0.5


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"restitution": 1.5}, "restitution = 1.5: must be less than or equal to 1"),
        ({"restitution": float("nan")}, "restitution = nan: must be a finite number"),
        ({"restitution": "1"}, "restitution = '1': must be a valid number"),
        ({"restitution": True}, "restitution = True: must be a valid number"),
        ({"tick_rate": 0}, "tick_rate = 0: must be greater than 0"),
        ({"walls": 1}, "walls = 1: must be a valid boolean"),
        ({"title": 5}, "title = 5: must be a valid string"),
        ({"box": (0, 0, 20)}, "box[3]: missing"),
        ({"box": (0, 0, 20, float("inf"))}, "box[3] = inf: must be a finite number"),
        ({"box": (20, 0, 0, 10)}, "left < right and bottom < top"),
        ({"restituton": 0.5}, "restituton = 0.5: no such key; did you mean restitution?"),
        ({"accuracy": "good"}, "accuracy"),
        ({"accuracy": 0.0}, "accuracy"),
        ({"budget_ms": -1.0}, "budget_ms = -1.0: must be greater than 0"),
        ({"forces": [{"kind": "gravity", "x": 0}]}, "forces[0].y: missing"),
        ({"forces": [{"kind": "gravity", "x": 0, "y": "down"}]}, "forces[0].y = 'down'"),
        ({"forces": [{"kind": "gravitas", "x": 0, "y": 0}]}, "forces[0].kind = "),
        ({"forces": [{"kind": "drag", "coefficient": -1}]}, "forces[0].coefficient = -1"),
        ({"forces": [{"kind": "drag", "coefficient": 1, "x": 1}]}, "forces[0].x = 1: no such key"),
        ({"limits": {"thrust": 5.0}}, 'limits.thrust = 5.0: needs a force of kind "thrust" in forces'),
        ({"limits": {"attract": 5.0}}, 'limits.attract = 5.0: needs a force of kind "attract" in forces'),
        ({"limits": {"max_balls": 1.5}}, "limits.max_balls = 1.5"),
        ({"model": {"substeps": 0}}, "model.substeps = 0"),
        (
            {"players": {"radius": 1, "mass": 1, "spawn_points": []}},
            "players.spawn_points = []: ",
        ),
        (
            {"players": {"radius": 1, "mass": 1, "spawn_points": [(0.5, 5)]}},
            "players.spawn_points[0] = [0.5, 5.0]: a ball of radius 1.0 there lies outside the box",
        ),
        ({"balls": {"position": [(1, 1)]}}, "balls.radius = None: missing"),
        ({"balls": {"position": [(1, 1)], "radius": 1, "colour": 3}}, "balls.colour = 3: no such key"),
        ({"balls": 7}, "balls = 7: must be Balls or a table"),
    ],
)
def test_wrong_keys_types_and_ranges_are_named(given, told):
    (problem,) = refused(**given)
    assert told in problem


def test_all_problems_are_told_at_once():
    problems = refused(restitution=2, tick_rate="60", forces=[{"kind": "gravity", "x": 0}], colour="red")
    assert len(problems) == 4


def test_a_ball_outside_the_box_is_refused():
    (problem,) = refused(balls=kg.Balls(position=[(0.5, 5), (5, 5)], radius=1))
    assert problem.startswith("balls.position[0] = [0.5, 5.0]: with radius 1.0 lies outside the box")


def test_a_ball_may_touch_the_wall():
    kg.Scene(box=BOX, balls=kg.Balls(position=[(1, 1), (19, 9)], radius=1))


def test_without_walls_a_ball_may_be_anywhere():
    kg.Scene(box=BOX, walls=False, balls=kg.Balls(position=[(-100, 5)], radius=1))


def test_a_peg_may_reach_into_the_wall_if_it_rests():
    kg.Scene(box=BOX, balls=kg.Balls(position=[(0, 5)], radius=1, mass=np.inf))
    refused(balls=kg.Balls(position=[(0, 5)], velocity=(1, 0), radius=1, mass=np.inf))


def test_an_overlap_is_refused_unless_allowed():
    balls = kg.Balls(position=[(5, 5), (12, 5), (6.5, 5)], radius=1)
    (problem,) = refused(balls=balls)
    assert problem.startswith("balls.position[2] = [6.5, 5.0]: overlaps ball 0: distance 1.5 is less than")
    assert len(kg.Scene(box=BOX, balls=balls, allow_overlap=True).balls) == 3


def test_touching_is_no_overlap():
    kg.Scene(box=BOX, balls=kg.Balls(position=[(5, 5), (7, 5)], radius=1))


def test_pegs_may_overlap_pegs_but_not_balls():
    pegs = kg.Balls(position=[(5, 5), (5.5, 5)], radius=1, mass=np.inf)
    kg.Scene(box=BOX, balls=pegs)
    (problem,) = refused(balls=pegs + kg.Balls(position=[(7, 5)], radius=1))
    assert "overlaps ball 1" in problem


def test_ten_thousand_balls_in_one_place_are_refused_without_listing_their_pairs():
    problems = refused(balls=kg.Balls(position=np.full((10_000, 2), 5.0), radius=1))
    assert len(problems) == 6
    assert "9994 more" in problems[-1]


def test_many_overlaps_are_counted():
    position = np.stack([np.linspace(1, 19, 200), np.full(200, 5.0)], axis=1)
    problems = refused(balls=kg.Balls(position=position, radius=0.1))
    assert len(problems) == 6
    assert "more'" in problems[-1]


def test_balls_and_groups_exclude_each_other():
    group = {"layout": "random", "count": 3, "radius": 0.5}
    (problem,) = refused(groups=[group])
    assert "balls or groups" in problem


@pytest.mark.parametrize(
    ("group", "told"),
    [
        ({"layout": "random", "count": 0, "radius": 0.5}, "groups[0].count = 0: must be greater than"),
        ({"layout": "random", "count": 5, "radius": [2, 1]}, "groups[0].radius = (2.0, 1.0): must be"),
        (
            {"layout": "random", "count": 5, "radius": 6},
            "groups[0].box = [0.0, 0.0, 20.0, 10.0]: must be at least",
        ),
        ({"layout": "random", "count": 5000, "radius": 0.5}, "groups[0].count = 5000: does not fit"),
        ({"layout": "random", "count": 5, "radius": 0.5, "area": [0, 0, 0, 5]}, "groups[0].area = "),
        ({"layout": "spiral", "count": 5}, "groups[0].layout = 'spiral': must be one of random"),
        ({"count": 5, "radius": 0.5}, "groups[0].layout: missing"),
        ({"layout": "triangle", "rows": 3, "apex": [5, 5]}, "groups[0].radius: missing"),
        ({"layout": "listed", "position": [[1, 1]], "radius": -1}, "groups[0].balls.radius[0] = -1.0"),
        (
            {"layout": "lattice", "columns": 9999, "rows": 9999, "origin": [1, 1], "spacing": 2, "radius": 1},
            "groups[0].rows = 9999: times columns",
        ),
    ],
)
def test_wrong_groups_are_named(group, told):
    with pytest.raises(kg.errors.SceneError) as caught:
        kg.Scene(box=BOX, groups=[group])
    assert told in str(caught.value)


def test_arguments_of_the_parts_are_checked_where_they_are_made():
    with pytest.raises(kg.errors.SceneError, match="Gravity: y = nan: must be a finite number"):
        kg.Gravity(0, float("nan"))
    with pytest.raises(kg.errors.SceneError, match="Attractor: softening = 0"):
        kg.Attractor(0, 0, 1, 0)
    with pytest.raises(
        kg.errors.SceneError, match="InputLimits: thurst = 5: no such key; did you mean thrust"
    ):
        kg.InputLimits(thurst=5)


def test_numbers_of_numpy_are_numbers():
    scene = kg.Scene(
        box=np.array([0, 0, 20, 10]).tolist(), restitution=np.float32(0.5), tick_rate=np.int64(60)
    )
    assert scene.restitution == 0.5
    assert type(scene.tick_rate) is float
