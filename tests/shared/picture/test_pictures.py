"""Whole pictures, and PNG."""

from __future__ import annotations

import io
import sys

import numpy as np
import pytest
from PIL import Image

import kuglice as kg
from kuglice.errors import MissingExtraError
from kuglice.picture import SPEED_PALETTE, Camera, background, draw, encode_png, png

BOX = (0.0, 0.0, 20.0, 10.0)


def test_where_a_ball_is_there_is_its_colour_and_elsewhere_the_background():
    position = np.array([[4.0, 8.0], [15.0, 3.0]])
    velocity = np.array([[0.0, 0.0], [6.0, 8.0]])
    pixels = draw(position, velocity, np.array([1.0, 2.0]), box=BOX, size=(400, 220))
    camera = Camera.fit(BOX, (400, 220))
    (slow_x, slow_y), (fast_x, fast_y) = camera.points(position).astype(int)
    assert np.abs(pixels[slow_y, slow_x].astype(int) - SPEED_PALETTE[0]).max() < 6
    assert np.abs(pixels[fast_y, fast_x].astype(int) - SPEED_PALETTE[-1]).max() < 6
    empty = background(camera)
    rows, columns = np.mgrid[0:220, 0:400] + 0.5
    away = np.ones((220, 400), dtype=bool)
    for (x, y), radius in zip(camera.points(position), camera.lengths(np.array([1.0, 2.0])), strict=True):
        away &= np.hypot(columns - x, rows - y) > radius + 1
    assert (pixels[away] == empty[away]).all()
    assert (pixels[~away] != empty[~away]).any(axis=1).mean() > 0.9


def test_walls_are_drawn_outside_of_the_box():
    camera = Camera.fit(BOX, (400, 220))
    with_walls, without = background(camera), background(camera, walls=False)
    left, top, right, bottom = camera.window()
    assert (
        with_walls[top + 1 : bottom - 1, left + 1 : right - 1]
        == without[top + 1 : bottom - 1, left + 1 : right - 1]
    ).all()
    assert with_walls[110, left - 1].sum() > without[110, left - 1].sum()
    assert (with_walls[0, 0] == without[0, 0]).all()


def test_no_balls_are_a_picture_too():
    pixels = draw(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), box=BOX)
    assert pixels.shape == (500, 1000, 3)


def test_png_keeps_every_pixel():
    pixels = np.random.default_rng(1).integers(0, 256, (13, 17, 3), dtype=np.uint8)
    assert (np.asarray(Image.open(io.BytesIO(encode_png(pixels)))) == pixels).all()


def test_scenes_and_worlds_show_themselves_in_notebooks():
    scene = kg.scenes.find("gas:n=50")
    world = kg.World(scene)
    assert Image.open(io.BytesIO(scene._repr_png_())).size == Camera.size_for(scene.box)
    before = world._repr_png_()
    world.run(20)
    assert world._repr_png_() == png(world) != before


def test_without_pillow_one_sentence_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(MissingExtraError, match=r"Pillow is not installed.*kuglice\[render\]"):
        encode_png(np.zeros((1, 1, 3), dtype=np.uint8))
