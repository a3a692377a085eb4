"""Colours by speed."""

from __future__ import annotations

import numpy as np
import pytest

import kuglice as kg
from kuglice.picture import PEG, SPEED_PALETTE, reference_speed, speed_colours
from kuglice.picture.oklab import from_srgb, to_srgb


def test_oklab_and_back_is_the_same_colour():
    colours = np.random.default_rng(2).integers(0, 256, (5000, 3), dtype=np.uint8)
    assert (to_srgb(from_srgb(colours)) == colours).all()


def test_oklab_of_white_and_of_pure_colours_is_as_published():
    lab = from_srgb(np.array([[255, 255, 255], [255, 0, 0], [0, 0, 255]], dtype=np.uint8))
    published = [[1.0, 0.0, 0.0], [0.62796, 0.22486, 0.12585], [0.45201, -0.03246, -0.31153]]
    assert lab == pytest.approx(np.array(published), abs=2e-4)


def test_the_palette_gets_ever_lighter_in_even_steps():
    lab = from_srgb(SPEED_PALETTE)
    # Bytes round each colour, so neighbours are compared ten apart.
    steps = np.linalg.norm(lab[10:] - lab[:-10], axis=1)
    assert (lab[10:, 0] > lab[:-10, 0]).all()
    assert steps.max() < 1.6 * steps.min()


def test_slow_gets_the_first_colour_and_the_reference_and_above_the_last():
    velocity = np.array([[0, 0], [3, 4], [30, 40], [1.5, 2]], dtype=np.float64)
    colours = speed_colours(velocity, 5.0)
    assert (colours[:, 3] == 255).all()
    assert (colours[0, :3] == SPEED_PALETTE[0]).all()
    assert (colours[1:3, :3] == SPEED_PALETTE[-1]).all()
    assert (colours[3, :3] == SPEED_PALETTE[128]).all()


def test_pegs_have_a_colour_of_their_own():
    colours = speed_colours(np.zeros((2, 2)), 1.0, np.array([False, True]))
    assert (colours[1, :3] == PEG).all()
    assert (colours[0, :3] == SPEED_PALETTE[0]).all()


def ball_at(x, y, **more):
    return kg.Balls(position=np.array([[x, y]]), velocity=np.zeros((1, 2)), radius=np.array([1.0]), **more)


def test_the_reference_is_twice_the_root_mean_square_of_the_speeds():
    balls = kg.Balls(
        position=np.array([[5.0, 5], [15, 5]]),
        velocity=np.array([[3.0, 0], [0, 3]]),
        radius=np.array([1.0, 1]),
    )
    assert reference_speed(kg.Scene(box=(0, 0, 20, 10), balls=balls)) == pytest.approx(6)


def test_a_fall_through_half_of_the_box_counts():
    scene = kg.Scene(box=(0, 0, 20, 10), balls=ball_at(5, 5), forces=[kg.Gravity(x=0, y=-10)])
    assert reference_speed(scene) == pytest.approx(10)


def test_where_nothing_moves_the_size_of_the_box_counts():
    assert reference_speed(kg.Scene(box=(0, 0, 30, 40), balls=ball_at(5, 5))) == pytest.approx(5)


@pytest.mark.parametrize("name", sorted(kg.scenes.TABLE))
def test_built_in_scenes_show_more_than_one_colour(name):
    scene = kg.scenes.find(name)
    world = kg.World(scene)
    world.run(30)
    moving = np.isfinite(world.mass)
    colours = speed_colours(world.velocity[moving], reference_speed(scene))
    assert len(np.unique(colours, axis=0)) > 1
