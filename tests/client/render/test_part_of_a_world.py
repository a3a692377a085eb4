"""A picture of a part of a world: walls where they are in sight, a scale, and the coordinates of what is seen."""

from __future__ import annotations

import numpy as np
import pytest

from client.render.stages import BOX, moment, scene
from kuglice_client.render import Renderer
from kuglice_client.render.moment import Window
from kuglice_client.render.overlays.scale import round_length

SIZE = (640, 360)
WORLD = (0.0, 0.0, 100.0, 60.0)


def differing(window: Window, *overlays: str, without: Window | None = None) -> np.ndarray:
    """(height, width) where a picture with it is another than one without."""
    one = Renderer(scene(), size=SIZE, overlays=overlays)
    frame = one.frame(moment(window=window)).copy()
    other = Renderer(scene(), size=SIZE).frame(moment(window=without))
    return (frame != other).any(axis=2)


def columns_and_rows(changed: np.ndarray) -> tuple[set[int], set[int]]:
    return (
        {int(x) for x in np.flatnonzero(changed.mean(axis=0) > 0.5)},
        {int(y) for y in np.flatnonzero(changed.mean(axis=1) > 0.5)},
    )


def test_a_wall_is_drawn_where_it_is_in_sight():
    camera = Renderer(scene(), size=SIZE).stage.camera
    # 5 metres of what lies left of the world are in sight, and nothing of what lies below it.
    columns, rows = columns_and_rows(differing(Window((-5.0, 10.0, 15.0, 20.0), WORLD)))
    wall = round(camera.points(np.array([[5.0, 0.0]]))[0, 0])
    assert columns <= set(range(wall - 4, wall + 1))
    assert columns
    assert not rows


def test_in_the_middle_of_a_world_no_wall_is_in_sight():
    assert not differing(Window((40.0, 20.0, 60.0, 30.0), WORLD)).any()


def test_walls_keep_their_place_in_a_picture_of_another_width():
    once = differing(Window((-5.0, 10.0, 15.0, 20.0), WORLD))
    twice = differing(Window((-10.0, 20.0, 30.0, 40.0), (0.0, 0.0, 200.0, 120.0)))
    assert (once == twice).all()


def test_an_edge_without_walls_is_fainter():
    part = (-5.0, 10.0, 15.0, 20.0)
    frames = [
        Renderer(scene(), size=SIZE).frame(moment(window=Window(part, WORLD, walls=walls))).astype(int).sum()
        for walls in (True, False)
    ]
    assert frames[0] > frames[1]


def test_the_scale_is_at_the_bottom_left_and_tells_where_one_is():
    here, there = Window((40.0, 20.0, 60.0, 30.0), WORLD), Window((41.0, 20.0, 61.0, 30.0), WORLD)
    changed = differing(here, "scale")
    rows, columns = np.nonzero(changed)
    assert rows.min() > 0.8 * SIZE[1]
    assert columns.max() < 0.8 * SIZE[0]
    renderer = Renderer(scene(), size=SIZE, overlays=("scale",))
    assert (renderer.frame(moment(window=here)).copy() != renderer.frame(moment(window=there))).any()


def test_a_picture_of_the_whole_box_has_a_scale_too():
    one = Renderer(scene(), size=SIZE, overlays=("scale",))
    left, top, right, bottom = one.stage.camera.window()
    # The walls of the box are drawn anew, and brighter: within them nothing differs.
    inside = np.s_[top + 4 : bottom - 4, left + 4 : right - 4]
    whole = one.frame(moment())[inside].copy()
    assert (whole == one.frame(moment(window=Window(BOX, BOX)))[inside]).all()
    assert (whole != Renderer(scene(), size=SIZE).frame(moment())[inside]).any()


@pytest.mark.parametrize(
    ("most", "length"),
    [(1.0, 1.0), (1.9, 1.0), (2.0, 2.0), (4.9, 2.0), (7.2, 5.0), (10.0, 10.0), (0.03, 0.02), (7.5e4, 5e4)],
)
def test_lengths_are_round(most, length):
    assert round_length(most) == pytest.approx(length)
