"""Discs on a picture: where a ball is there is its colour, and where none is there is not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice import _core
from shared.picture.canvas import black, colours, disc_coverage, floats, white

WIDTH, HEIGHT = 48, 40


@given(x=st.floats(-10, WIDTH + 10), y=st.floats(-10, HEIGHT + 10), radius=st.floats(0.05, 30))
def test_every_pixel_is_covered_by_its_area(x, y, radius):
    pixels = black(WIDTH, HEIGHT)
    _core.draw_discs(pixels, floats((x, y)), floats(radius).ravel(), white())
    covered = pixels[:, :, 0] / 255
    assert np.abs(covered - disc_coverage(WIDTH, HEIGHT, x, y, radius)).max() < 0.035


@given(x=st.floats(15, 33), y=st.floats(15, 25), radius=st.floats(0.3, 14))
def test_the_whole_disc_has_its_area(x, y, radius):
    pixels = black(WIDTH, HEIGHT)
    _core.draw_discs(pixels, floats((x, y)), floats(radius).ravel(), white())
    assert pixels[:, :, 0].sum() / 255 == pytest.approx(np.pi * radius**2, rel=0.01, abs=0.05)


@given(x=st.floats(-5, 30), y=st.floats(-5, 30), radius=st.floats(0.1, 20), shaded=st.booleans())
def test_a_clipped_disc_is_a_part_of_the_whole_one(x, y, radius, shaded):
    colour = colours((200, 90, 30, 255))
    large = black(80, 80)
    _core.draw_discs(large, floats((x + 25, y + 25)), floats(radius).ravel(), colour, shaded=shaded)
    small = black(25, 27)
    _core.draw_discs(small, floats((x, y)), floats(radius).ravel(), colour, shaded=shaded)
    # The same numbers seen from another origin may round to the other side.
    assert np.abs(large[25:52, 25:50].astype(int) - small).max() <= 1


def test_a_disc_far_outside_changes_nothing():
    pixels = black(8, 8)
    far = floats((1e300, 0), (-1e9, 4), (4, -1e9), (20, 4), (4, 20), (-9, -9))
    _core.draw_discs(pixels, far, np.full(6, 5.0), white(6), shaded=True)
    assert not pixels.any()


def test_a_disc_larger_than_the_picture_fills_it():
    pixels = black(17, 9)
    _core.draw_discs(pixels, floats((8, 4)), floats(1000).ravel(), white())
    assert (pixels == 255).all()


@pytest.mark.parametrize("shaded", [False, True])
@pytest.mark.parametrize("radius", [0.8, 2.4, 6.0])
@pytest.mark.parametrize("opacity", [0, 64, 128, 255])
def test_opacity_is_the_weight_of_the_colour(shaded, radius, opacity):
    pixels = np.full((21, 21, 3), 100, dtype=np.uint8)
    _core.draw_discs(
        pixels, floats((10.5, 10.5)), floats(radius).ravel(), colours((220, 0, 100, opacity)), shaded=shaded
    )
    part = opacity / 255
    expected = np.array([220, 0, 100]) * part + 100 * (1 - part)
    if not (shaded and radius > 2):
        assert np.abs(pixels[10, 10] - expected).max() <= 1
    assert (pixels[0, 0] == 100).all()


def test_later_discs_lie_over_earlier_ones():
    pixels = black(20, 20)
    both = floats((10, 10), (10, 10))
    _core.draw_discs(pixels, both, np.full(2, 6.0), colours((255, 0, 0, 255), (0, 255, 0, 255)))
    assert pixels[10, 10].tolist() == [0, 255, 0]


@pytest.mark.parametrize("radius", [3.6, 6.0, 40.0])
def test_a_shaded_ball_has_its_colour_in_the_middle_and_a_dark_rim_away_from_the_light(radius):
    side = int(2 * radius + 5) | 1
    pixels = black(side, side)
    middle = side / 2
    _core.draw_discs(
        pixels, floats((middle, middle)), floats(radius).ravel(), colours((180, 60, 120, 255)), shaded=True
    )
    centre = pixels[side // 2, side // 2].astype(int)
    assert np.abs(centre - [180, 60, 120]).max() <= 12
    inside = int(radius * 0.62)
    lower = pixels[side // 2 + inside, side // 2 + inside].astype(int)
    upper = pixels[side // 2 - inside, side // 2 - inside].astype(int)
    assert lower.sum() < 0.85 * centre.sum()
    assert upper.sum() > lower.sum()


def test_numbers_that_are_none_and_radii_that_are_none_draw_nothing():
    pixels = black(10, 10)
    nan, inf = float("nan"), float("inf")
    center = floats((nan, 5), (5, inf), (5, 5), (5, 5), (5, 5))
    _core.draw_discs(pixels, center, np.array([3, 3, nan, -3, 0.0]), white(5))
    assert not pixels.any()


@pytest.mark.parametrize(
    ("name", "center", "radius", "colour"),
    [
        ("center", np.zeros((2, 3)), np.ones(2), white(2)),
        ("radius", np.zeros((2, 2)), np.ones(3), white(2)),
        ("colour", np.zeros((2, 2)), np.ones(2), white(1)),
        ("colour", np.zeros((2, 2)), np.ones(2), np.zeros((2, 3), dtype=np.uint8)),
    ],
)
def test_arrays_of_a_wrong_shape_are_named(name, center, radius, colour):
    with pytest.raises(ValueError, match=name):
        _core.draw_discs(black(4, 4), center, radius, colour)


@pytest.mark.parametrize("pixels", [np.zeros((4, 4, 4), np.uint8), np.zeros((4, 8, 3), np.uint8)[:, ::2]])
def test_pictures_of_another_layout_are_refused(pixels):
    with pytest.raises(ValueError, match="pixels"):
        _core.draw_discs(pixels, np.zeros((1, 2)), np.ones(1), white())


def test_arrays_in_any_memory_layout_are_read():
    plain, odd = black(30, 30), black(30, 30)
    center = floats((5, 6), (20, 21), (11, 25))
    _core.draw_discs(plain, center, np.array([4.0, 5, 3]), white(3))
    _core.draw_discs(odd, np.asfortranarray(center), np.array([4.0, 0, 5, 0, 3])[::2], white(6)[::2])
    assert (plain == odd).all()
