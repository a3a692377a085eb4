"""Layouts: no two balls overlap, all lie inside, and equal recipes give equal bits everywhere."""

import hashlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kuglice as kg
from kuglice.layout import LatticeGroup, ListedGroup, RandomGroup, TriangleGroup, place
from kuglice.layout.stream import RandomStream, directions

BOX = (-3.0, 5.0, 29.0, 23.0)
AREA = 32.0 * 18.0


def count_for(packing, radius):
    return max(1, int(packing * AREA / (math.pi * radius * radius)))


def overlaps(balls):
    """Every pair, by the definition: the judge of all grids."""
    difference = balls.position[:, None] - balls.position[None]
    distance = np.sqrt((difference**2).sum(axis=2))
    close = distance < balls.radius[:, None] + balls.radius[None]
    return int(np.triu(close, 1).sum())


def assert_inside(balls, area):
    low = balls.position - balls.radius[:, None]
    high = balls.position + balls.radius[:, None]
    assert (low >= area[:2]).all()
    assert (high <= area[2:]).all()


@settings(max_examples=25)
@given(st.floats(0.01, 0.7), st.floats(0.15, 1.5), st.integers(0, 2**64 - 1))
def test_equal_discs_are_placed_inside_and_apart_up_to_a_packing_of_07(packing, radius, seed):
    # Few large discs lose much of the area to the walls.
    count = count_for(packing * (1 - radius / 4), radius)
    (balls,) = [place([RandomGroup(count=count, radius=radius, seed=seed)], BOX)]
    assert len(balls) == count
    assert overlaps(balls) == 0
    assert_inside(balls, BOX)


@settings(max_examples=25)
@given(st.floats(0.01, 0.4), st.floats(1, 30), st.integers(0, 2**64 - 1))
def test_discs_of_mixed_sizes_are_placed_inside_and_apart(packing, spread, seed):
    smallest, largest = 1.0 / spread, 1.0
    mean_square = (smallest * smallest + smallest * largest + largest * largest) / 3
    count = min(count_for(packing, math.sqrt(mean_square)), 1500)
    balls = place([RandomGroup(count=count, radius=(smallest, largest), seed=seed)], BOX)
    assert len(balls) == count
    assert overlaps(balls) == 0
    assert_inside(balls, BOX)
    assert smallest <= balls.radius.min() <= balls.radius.max() <= largest


@settings(max_examples=25)
@given(st.sampled_from([0.1, 0.3, 0.5]), st.floats(0.05, 3), st.integers(0, 1000))
def test_random_balls_keep_clear_of_groups_before_them(packing, peg, seed):
    pegs = LatticeGroup(columns=5, rows=4, origin=(0, 7), spacing=(6.5, 4.5), radius=peg, mass=math.inf)
    free = 1 - 20 * (peg + 0.3) ** 2 * math.pi / AREA
    balls = RandomGroup(count=count_for(packing * max(free, 0.02) * 0.8, 0.3), radius=0.3, seed=seed)
    placed = place([pegs, balls], BOX)
    movable = np.isfinite(placed.mass)
    difference = placed.position[movable][:, None] - placed.position[~movable][None]
    assert (np.sqrt((difference**2).sum(axis=2)) >= peg + 0.3).all()
    assert overlaps(placed[movable]) == 0


def test_random_balls_keep_clear_of_what_lies_beside_their_area():
    large = ListedGroup(balls=kg.Balls(position=[(10, 14)], radius=4))
    small = RandomGroup(count=80, radius=0.25, area=(14.5, 5, 20, 23))
    assert overlaps(place([large, small], BOX)) == 0
    near = RandomGroup(count=80, radius=0.25, area=(12, 5, 20, 23))
    assert overlaps(place([large, near], BOX)) == 0


def test_placing_is_a_function_of_the_seed():
    def of(seed):
        return place([RandomGroup(count=200, radius=0.3, speed=2, seed=seed)], BOX)

    assert of(5) == of(5)
    assert of(5) != of(6)


@pytest.mark.parametrize(
    ("group", "digest"),
    [
        (RandomGroup(count=300, radius=0.3, speed=3, seed=11), "c60232d68d3c3ceb"),
        (RandomGroup(count=1200, radius=0.3, speed=3, seed=11), "fd2411bd3a90475d"),
        (RandomGroup(count=300, radius=(0.1, 0.9), speed=3, seed=11), "2c75a78c1f22c3c9"),
        (
            LatticeGroup(arrangement="hexagonal", columns=9, rows=7, origin=(0, 7), spacing=1.3, radius=0.6),
            "2cdd373f4ad574ba",
        ),
        (TriangleGroup(rows=12, apex=(5, 14), spacing=1.1, radius=0.5), "d29afb5f6f1c28cd"),
    ],
    ids=["sequential", "melted", "mixed", "hexagonal", "triangle"],
)
def test_placements_have_the_same_bits_on_every_platform(group, digest):
    # Mint again, when a layout is changed on purpose, by copying the digests of the failures.
    balls = place([group], BOX)
    found = hashlib.sha256(b"".join(balls.to_message().values())).hexdigest()[:16]
    assert found == digest


def test_a_dense_start_is_no_crystal():
    """Melted: on a lattice, a sixfold order parameter would be close to 1."""
    balls = place([RandomGroup(count=count_for(0.55, 0.25), radius=0.25, seed=2)], BOX)
    middle = np.flatnonzero((np.abs(balls.position - (13, 14)) < (12, 6)).all(axis=1))
    order = []
    for ball in middle:
        apart = balls.position - balls.position[ball]
        near = np.argsort((apart**2).sum(axis=1))[1:7]
        angle = np.arctan2(apart[near, 1], apart[near, 0])
        order.append(np.exp(6j * angle).mean())
    assert abs(np.mean(order)) < 0.3


def test_balls_are_spread_evenly_over_the_area():
    balls = place([RandomGroup(count=2000, radius=0.05, seed=4)], BOX)
    quarters = np.histogram2d(*balls.position.T, bins=2, range=[(-3, 29), (5, 23)])[0]
    # Binomial: a standard deviation of 19.
    assert np.abs(quarters - 500).max() < 80


def test_speed_is_exact_and_directions_are_even():
    balls = place([RandomGroup(count=3000, radius=0.01, speed=5.0, velocity=(1, 2), seed=9)], BOX)
    own = balls.velocity - (1.0, 2.0)
    assert np.allclose(np.sqrt((own**2).sum(axis=1)), 5.0, rtol=1e-12)
    assert np.abs(own.mean(axis=0)).max() < 5 * 5 / math.sqrt(2 * 3000)
    unit = directions(RandomStream(3, 1), 20_000)
    sector = np.histogram(np.arctan2(unit[:, 1], unit[:, 0]), bins=8, range=(-math.pi, math.pi))[0]
    assert np.abs(sector - 2500).max() < 5 * 47


def test_mass_follows_density_or_is_given():
    dense = place([RandomGroup(count=3, radius=2, density=3)], BOX)
    assert dense.mass.tolist() == [3 * 3.141592653589793 * 2 * 2] * 3
    assert place([RandomGroup(count=3, radius=2, mass=7)], BOX).mass.tolist() == [7.0] * 3
    assert np.isinf(place([RandomGroup(count=3, radius=2, mass=math.inf)], BOX).mass).all()


def test_a_triangle_of_100_rows_has_5050_balls_and_its_apex_first():
    balls = place([TriangleGroup(rows=100, apex=(1, 2), spacing=1.0, radius=0.4)], BOX)
    assert len(balls) == 5050
    assert balls.position[0].tolist() == [1.0, 2.0]
    assert overlaps(balls[:500]) == 0
    assert (balls.position[:, 0] >= 1.0).all()
    row = balls.position[-100:]
    assert np.ptp(row[:, 0]) == 0
    assert row[0, 1] + row[-1, 1] == pytest.approx(4.0)


def test_a_square_lattice_counts_rightwards_then_upwards():
    balls = place([LatticeGroup(columns=3, rows=2, origin=(1, 10), spacing=(2, 4), radius=0.5)], BOX)
    assert balls.position.tolist() == [[1, 10], [3, 10], [5, 10], [1, 14], [3, 14], [5, 14]]


def test_a_hexagonal_lattice_staggers_and_leaves_out_the_last_of_odd_rows():
    group = LatticeGroup(arrangement="hexagonal", columns=3, rows=2, origin=(0, 10), spacing=2, radius=0.5)
    balls = place([group], BOX)
    assert balls.position[:, 0].tolist() == [0, 2, 4, 1, 3]
    assert balls.position[3, 1] == pytest.approx(10 + math.sqrt(3))


def test_groups_are_numbered_in_order():
    listed = ListedGroup(balls=kg.Balls(position=[(1, 10)], radius=0.1))
    lattice = LatticeGroup(columns=2, rows=1, origin=(10, 10), spacing=2, radius=0.2)
    assert place([listed, lattice], BOX).radius.tolist() == [0.1, 0.2, 0.2]
    assert place([lattice, listed], BOX).radius.tolist() == [0.2, 0.2, 0.1]


@pytest.mark.parametrize("packing", [0.3, 0.6])
def test_a_hundred_thousand_balls(packing):
    scene = kg.scenes.gas(n=100_000, packing=packing)
    assert len(scene.balls) == 100_000
    assert len(kg.World(scene).overlapping()) == 0


def test_an_area_that_is_too_full_is_refused():
    with pytest.raises(kg.errors.SceneError, match=r"count = 90: does not fit: these balls would fill 0\.9"):
        kg.Scene(box=(0, 0, 10, 7.85), groups=[RandomGroup(count=90, radius=0.5)])
    with pytest.raises(kg.errors.SceneError, match="does not fit"):
        kg.Scene(box=(0, 0, 10, 10), groups=[RandomGroup(count=300, radius=(0.1, 0.6))])
    with pytest.raises(kg.errors.SceneError, match=r"place: groups\[0\].count = 300: does not fit"):
        place([RandomGroup(count=300, radius=(0.1, 0.6))], (0, 0, 10, 10))
