"""The liquid surface: drops of the balls' own size that melt together."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice import _core
from shared.picture.canvas import black, floats

BLUE = np.array([[0, 0, 255]], dtype=np.uint8)


def wet(center, radius, *, size=(120, 90), palette=BLUE, value=None, window=None):
    pixels = black(*size)
    values = np.zeros(len(radius)) if value is None else np.array(value, dtype=np.float64)
    _core.draw_fluid(pixels, center, np.array(radius, dtype=np.float64), values, palette, 1.0, window)
    return pixels


@given(x=st.floats(40, 80), y=st.floats(40, 50), radius=st.floats(3, 30))
def test_a_lone_ball_is_a_drop_of_its_own_size(x, y, radius):
    drop = wet(floats((x, y)), [radius])[:, :, 2] > 60
    assert drop.sum() == pytest.approx(np.pi * radius**2, abs=0.35 * 2 * np.pi * radius)
    rows, columns = np.nonzero(drop)
    distance = np.hypot(columns + 0.5 - x, rows + 0.5 - y)
    assert distance.max() < radius + 1.5


def test_close_balls_melt_together_and_far_ones_do_not():
    close = wet(floats((50, 45), (73, 45)), [10, 10])
    assert close[45, 61, 2] > 40
    far = wet(floats((30, 45), (90, 45)), [10, 10])
    assert not far[:, 55:65].any()


def test_the_surface_is_smooth_at_its_edge():
    row = wet(floats((60.5, 45)), [20])[45, :, 2].astype(int)
    edge = row[36:44]
    assert ((edge > 20) & (edge < 0.8 * row[44])).any()
    assert (np.diff(edge) >= -3).all()


def test_the_colour_follows_the_value_of_the_nearest_ball():
    palette = np.array([[255, 0, 0], [0, 255, 0]], dtype=np.uint8)
    pixels = wet(floats((30, 45), (90, 45)), [12, 12], palette=palette, value=[0.0, 1.0])
    assert pixels[45, 30].argmax() == 0
    assert pixels[45, 90].argmax() == 1


def test_a_packed_liquid_has_no_holes():
    x, y = np.meshgrid(np.arange(5, 115, 7.0), np.arange(5, 85, 7.0))
    pixels = wet(np.stack([x.ravel(), y.ravel()], axis=1), [3.5] * x.size)
    assert (pixels[10:78, 10:108, 2] > 40).all()


def test_nothing_gets_wet_outside_of_the_window():
    window = (20, 10, 61, 53)
    inside = wet(floats((60, 50)), [30], window=window)
    everywhere = wet(floats((60, 50)), [30])
    assert (inside[10:53, 20:61] == everywhere[10:53, 20:61]).all()
    inside[10:53, 20:61] = 0
    assert not inside.any()


@pytest.mark.parametrize("size", [(1, 1), (2, 3), (7, 5)])
def test_pictures_of_any_size_can_be_drawn_on(size):
    assert wet(floats((1, 1)), [50], size=size)[:, :, 2].min() > 40


@pytest.mark.parametrize("window", [(5, 5, 2, 2), (0, 0, 10**6, 10**6), (200, 200, 300, 300)])
def test_windows_that_reach_nowhere_or_too_far_are_clipped(window):
    pixels = wet(floats((60, 45)), [20], window=window)
    assert pixels.any() == (window[0] == 0)


def test_balls_outside_and_numbers_that_are_none_draw_nothing():
    nan = float("nan")
    assert not wet(floats((nan, 4), (-500, 4), (1e300, 1e300), (5, 5)), [5, 5, 5, -1]).any()


def test_a_value_that_is_none_gets_some_colour():
    palette = np.array([[0, 0, 200], [0, 0, 250]], dtype=np.uint8)
    assert wet(floats((60, 45)), [20], palette=palette, value=[float("nan")])[45, 60, 2] > 60


def test_a_palette_and_an_opacity_are_needed():
    with pytest.raises(ValueError, match="palette"):
        wet(floats((1, 1)), [5], palette=np.zeros((0, 3), dtype=np.uint8))
    with pytest.raises(ValueError, match=r"opacity.*1\.5"):
        _core.draw_fluid(black(3, 3), floats((1, 1)), np.ones(1), np.ones(1), BLUE, 1.5)
