"""Rings, segments, rectangles and fading."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice import _core
from shared.picture.canvas import black, colours, disc_coverage, floats, white


@given(x=st.floats(15, 25), y=st.floats(15, 25), radius=st.floats(6, 14), thickness=st.floats(0.5, 3.5))
def test_a_ring_is_a_disc_without_the_disc_inside(x, y, radius, thickness):
    pixels = black(40, 40)
    _core.draw_rings(pixels, floats((x, y)), floats(radius).ravel(), thickness, white())
    expected = disc_coverage(40, 40, x, y, radius) - disc_coverage(40, 40, x, y, radius - thickness)
    assert np.abs(pixels[:, :, 1] / 255 - expected).max() < 0.06


@given(
    start=st.tuples(st.floats(12, 28), st.floats(12, 28)),
    end=st.tuples(st.floats(12, 28), st.floats(12, 28)),
    thickness=st.floats(2, 9),
)
def test_a_segment_has_the_area_of_a_rectangle_and_a_disc(start, end, thickness):
    pixels = black(40, 40)
    _core.draw_segments(pixels, floats(start), floats(end), floats(thickness).ravel(), white())
    length = np.hypot(end[0] - start[0], end[1] - start[1])
    area = length * thickness + np.pi * thickness**2 / 4
    assert pixels[:, :, 2].sum() / 255 == pytest.approx(area, abs=0.1 * (2 * length + np.pi * thickness))


def test_a_segment_is_where_it_is_said_to_be():
    pixels = black(30, 10)
    _core.draw_segments(pixels, floats((5, 5)), floats((25, 5)), floats(4).ravel(), colours((9, 8, 7, 255)))
    assert (pixels[3:7, 6:24] == [9, 8, 7]).all()
    assert not pixels[:2].any()
    assert not pixels[8:].any()
    assert not pixels[:, :2].any()


def test_joints_of_a_lightened_trail_are_no_brighter_than_the_rest():
    pixels = black(40, 11)
    along = np.arange(5.0, 36.0, 3.0)
    points = np.stack([along, np.full_like(along, 5.5)], axis=1)
    faint = np.tile(colours((255, 255, 255, 100)), (len(points) - 1, 1))
    _core.draw_segments(pixels, points[:-1], points[1:], np.full(len(faint), 3.0), faint, lighten=True)
    assert (pixels[5, 6:34] == 100).all()


@given(
    left=st.floats(2, 10), top=st.floats(2, 10), width=st.floats(6, 25), height=st.floats(6, 25),
    thickness=st.floats(0.2, 3),
)  # fmt: skip
def test_an_outline_has_its_area_and_no_corner_is_drawn_twice(left, top, width, height, thickness):
    pixels = black(40, 40)
    half = colours((255, 255, 255, 128))
    _core.draw_rectangles(pixels, floats((left, top, left + width, top + height)), thickness, half)
    area = 2 * (width + height) * thickness
    assert pixels[:, :, 0].sum() / 128 == pytest.approx(area, rel=0.02, abs=1.5)
    assert pixels.max() <= 128


def test_a_point_as_rectangle_is_a_dot():
    pixels = black(9, 9)
    _core.draw_rectangles(pixels, floats((4.5, 4.5, 4.5, 4.5)), 3.0, white())
    assert pixels[:, :, 0].sum() == 9 * 255


def test_fading_arrives_at_the_target_and_leaves_no_ghost():
    rng = np.random.default_rng(5)
    pixels = rng.integers(0, 256, (8, 9, 3), dtype=np.uint8)
    target = rng.integers(0, 256, (8, 9, 3), dtype=np.uint8)
    before = np.abs(pixels.astype(int) - target)
    _core.fade(pixels, target, 128)
    assert (np.abs(pixels.astype(int) - target) <= before / 2).all()
    for _ in range(255):
        _core.fade(pixels, target, 255)
    assert (pixels == target).all()


def test_fading_refuses_other_shapes_and_shares():
    with pytest.raises(ValueError, match="target"):
        _core.fade(black(2, 2), black(3, 2), 200)
    with pytest.raises(ValueError, match="257"):
        _core.fade(black(2, 2), black(2, 2), 257)
