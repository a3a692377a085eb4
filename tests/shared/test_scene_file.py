"""Scenes as TOML files: readable, exact, and with errors that name the file."""

import math

import numpy as np
import pytest

import kuglice as kg
from kuglice.layout import LatticeGroup, ListedGroup, RandomGroup


def write(tmp_path, text):
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_every_built_in_scene_comes_back_bit_for_bit(name, tmp_path):
    scene = kg.scenes.TABLE[name]()
    scene.save(tmp_path / "scene.toml")
    again = kg.Scene.load(tmp_path / "scene.toml")
    assert again == scene
    assert kg.World(again).state_hash == kg.World(scene).state_hash


def test_balls_that_no_group_explains_are_written_one_by_one(tmp_path):
    random = np.random.default_rng(3)
    balls = kg.Balls(
        position=np.stack([np.arange(1, 20, 2.0), random.uniform(1, 9, 10)], axis=1),
        velocity=random.normal(size=(10, 2)),
        radius=random.uniform(0.1, 0.9, 10),
        mass=[math.inf] * 3 + [1 / 3] * 7,
    )
    scene = kg.Scene(box=(0, 0, 20, 10), balls=balls)
    scene.save(tmp_path / "scene.toml")
    assert kg.Scene.load(tmp_path / "scene.toml") == scene


def test_a_gas_is_saved_as_its_recipe(tmp_path):
    kg.scenes.gas(n=1000).save(tmp_path / "gas.toml")
    text = (tmp_path / "gas.toml").read_text()
    assert 'layout = "random"' in text
    assert "count = 1000" in text
    assert len(text.splitlines()) < 20


def test_a_stale_recipe_is_not_saved(tmp_path):
    gas = kg.scenes.gas(n=10)
    moved = gas.model_copy(update={"balls": gas.balls[:5]})
    moved.save(tmp_path / "scene.toml")
    assert kg.Scene.load(tmp_path / "scene.toml").balls == moved.balls


def test_a_file_written_by_hand(tmp_path):
    path = write(
        tmp_path,
        """
        title = "By hand"
        box = [0, 0, 20, 10]
        restitution = 1

        [[forces]]
        kind = "gravity"
        x = 0
        y = -10

        [[groups]]
        layout = "listed"
        position = [[2, 2], [18, 2]]
        radius = 0.5
        mass = inf

        [[groups]]
        layout = "lattice"
        columns = 3
        rows = 2
        origin = [5, 5]
        spacing = 2
        radius = [0.2, 0.9]

        [limits]
        kick = 5
        """,
    )
    scene = kg.Scene.load(path)
    assert [type(group) for group in scene.groups] == [ListedGroup, LatticeGroup]
    assert np.isinf(scene.balls.mass).tolist() == [True] * 2 + [False] * 6
    assert scene.forces == (kg.Gravity(0, -10),)
    assert scene.limits.kick == 5.0


def test_an_error_names_file_key_value_and_bound(tmp_path):
    path = write(tmp_path, "box = [0, 0, 20, 10]\nrestitution = 1.5\ntick_rte = 60")
    with pytest.raises(kg.errors.SceneError) as caught:
        kg.Scene.load(path)
    assert str(caught.value).splitlines() == [
        f"{path}: 2 problems",
        "  restitution = 1.5: must be less than or equal to 1",
        "  tick_rte = 60: no such key; did you mean tick_rate?",
    ]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("box = [0, 0, 20", "not TOML"),
        ("box = " + "[" * 5000, "not TOML"),
        ("", "box: missing"),
        ("box = [0, 0, 20, nan]", r"box\[3\] = nan: must be a finite number"),
        ("box = [0, 0, 20, 10]\nbox = 1", "not TOML"),
        ("box = [0, 0, 20, 1979-05-27]", r"box\[3\] = .*valid number"),
        ("box = [0, 0, 20, 10]\n[balls]\nposition = [[30, 5]]\nradius = 1", "outside the box"),
        ("box = [0, 0, 20, 10]\n[balls]\nposition = [[5, 5], [6, 5]]\nradius = 1", "overlaps ball 0"),
        ("box = [0, 0, 20, 10]\n[balls]\nposition = [[5, 5], 6]\nradius = 1", "rows of equal length"),
    ],
)
def test_wrong_files_are_refused(tmp_path, text, told):
    path = write(tmp_path, text)
    with pytest.raises(kg.errors.SceneError, match=told) as caught:
        kg.Scene.load(path)
    assert str(caught.value).startswith(str(path))


HEAD = "box = [0, 0, 20, 10]\n"
RANDOM = HEAD + '[[groups]]\nlayout = "random"\ncount = 4\n'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (HEAD + '[model]\nintegrator = "rk5"', "model.integrator = 'rk5': must be one of euler, "),
        (HEAD + '[model]\ncontacts = ""', "model.contacts = '': must be one of "),
        (RANDOM + "radius = -1", "groups[0].radius = -1: must be greater than 0"),
        (RANDOM + 'radius = "x"', "groups[0].radius = 'x': must be a valid number"),
        (RANDOM + "radius = [1, -2]", "groups[0].radius[1] = -2: must be greater than 0"),
        (RANDOM + "radius = [1]", "groups[0].radius[1]: missing"),
        (RANDOM + "radius = [1, 2, 3]", "groups[0].radius = [1, 2, 3]: must have at most 2 items, not 3"),
        (RANDOM + "radius = 0.5\nsped = 1", "groups[0].sped = 1: no such key"),
        (
            HEAD + '[[groups]]\nlayout = "rndom"',
            "groups[0].layout = 'rndom': must be one of random, lattice, triangle, listed;"
            " did you mean random?",
        ),
        (HEAD + "[[groups]]\ncount = 3", "groups[0].layout: missing, must be one of random, lattice"),
        (
            HEAD + '[[forces]]\nkind = "gravty"\nx = 0\ny = 1',
            "forces[0].kind = 'gravty': must be one of gravity, drag, attractor, spring, thrust, attract;"
            " did you mean gravity?",
        ),
        (HEAD + "[[forces]]\nkind = 3", "forces[0].kind = 3: must be one of gravity"),
        (HEAD + "[[forces]]\nx = 3", "forces[0].kind: missing, must be one of gravity"),
        (HEAD + "forces = [3]", "forces[0] = 3: must be a table"),
        (HEAD + "[limits]\nkik = 3", "limits.kik = 3: no such key"),
        ("box = 3", "box = 3: must be an array"),
    ],
)
def test_one_mistake_is_one_sentence_in_the_words_of_the_file(tmp_path, text, told):
    path = write(tmp_path, text)
    with pytest.raises(kg.errors.SceneError) as caught:
        kg.Scene.load(path)
    assert str(caught.value).startswith(f"{path}: {told}")


def test_a_file_that_is_not_there_or_not_text_is_refused(tmp_path):
    with pytest.raises(kg.errors.SceneError, match="cannot be read: No such file"):
        kg.Scene.load(tmp_path / "no.toml")
    with pytest.raises(kg.errors.SceneError, match="cannot be read"):
        kg.Scene.load(tmp_path)
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(kg.errors.SceneError, match="not TOML"):
        kg.Scene.load(tmp_path / "bytes.toml")


def test_text_that_looks_like_an_array_survives(tmp_path):
    scene = kg.Scene(title="[\n    1.0,\n    2.0,\n]", box=(0, 0, 1, 1), groups=())
    scene.save(tmp_path / "scene.toml")
    assert kg.Scene.load(tmp_path / "scene.toml") == scene


def test_a_random_group_in_a_file_is_the_one_in_code(tmp_path):
    path = write(
        tmp_path,
        'box = [0, 0, 20, 10]\n[[groups]]\nlayout = "random"\ncount = 40\nradius = 0.5\nspeed = 2\nseed = 7',
    )
    group = RandomGroup(count=40, radius=0.5, speed=2, seed=7)
    assert kg.Scene.load(path) == kg.Scene(box=(0, 0, 20, 10), groups=[group])
