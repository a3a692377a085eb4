"""From the plane to pixels."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import PictureError
from kuglice.picture import Camera

sides = st.floats(0.01, 1e6)
origins = st.floats(-1e6, 1e6)
pixels = st.integers(40, 4000)


@given(x=origins, y=origins, wide=sides, tall=sides, size=st.tuples(pixels, pixels))
def test_the_whole_box_is_seen_as_large_as_it_fits(x, y, wide, tall, size):
    camera = Camera.fit((x, y, x + wide, y + tall), size, margin=12)
    left, top, right, bottom = camera.rectangles(np.array([camera.box]))[0]
    width, height = size
    slack = 1e-3 * max(size)
    assert min(left, top) > 12 - slack
    assert right < width - 12 + slack
    assert bottom < height - 12 + slack
    assert right - left > width - 24 - slack or bottom - top > height - 24 - slack


def test_up_is_up_and_lengths_keep_their_proportions():
    camera = Camera.fit((0, 0, 20, 10), (240, 140), margin=20)
    assert camera.scale == 10
    assert camera.points(np.array([[0, 0], [20, 10], [5, 9]])).tolist() == [[20, 120], [220, 20], [70, 30]]
    assert camera.lengths(np.array([0.5, 2])).tolist() == [5, 20]
    assert camera.rectangles(np.array([[0, 0, 5, 1]])).tolist() == [[20, 110, 70, 120]]
    assert camera.window() == (20, 20, 220, 120)


@given(wide=sides, tall=sides)
def test_a_size_for_a_box_is_even_and_as_long_as_asked(wide, tall):
    width, height = Camera.size_for((0, 0, wide, tall), longest=640)
    assert width % 2 == height % 2 == 0
    assert max(width, height) == 640
    shorter = 640 * min(wide, tall) / max(wide, tall)
    assert min(width, height) == 2 or abs(min(width, height) - shorter) <= 1 + 1e-9


@pytest.mark.parametrize("size", [(0, 10), (10, -1), (20_000, 10)])
def test_sizes_that_cannot_be_are_refused(size):
    with pytest.raises(PictureError, match=rf"{size[0]}x{size[1]}.*16384"):
        Camera.fit((0, 0, 1, 1), size)


@pytest.mark.parametrize("box", [(0, 0, 0, 1), (0, 0, 1, float("inf")), (3, 0, 1, 1)])
def test_boxes_that_cannot_be_seen_are_refused(box):
    with pytest.raises(PictureError, match="box"):
        Camera.fit(box, (10, 10))
