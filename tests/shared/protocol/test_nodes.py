"""Which nodes cover a rectangle: all that is in it, nothing that is far from it, and the same as the compiled core."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from kuglice import _core
from kuglice.errors import ProtocolError
from kuglice.protocol import Keys, Nodes

BOX = (-10.0, 5.0, 30.0, 25.0)
depths = st.integers(1, 5)
coordinates = st.floats(-60, 60, allow_nan=False)
ROUNDING = 1e-12


def core(depth: int) -> _core.Regions:
    return _core.Regions(box=BOX, depth=depth, position_quantum=1, velocity_quantum=1, shapes=[])


@example(depth=2, corner=(-3.74e-131, 0.0), size=(0.0, 10.0), seed=0)
@given(
    depths,
    st.tuples(coordinates, coordinates),
    st.tuples(st.floats(0, 30), st.floats(0, 30)),
    st.integers(0, 2**32),
)
def test_every_point_of_a_rectangle_is_in_a_node_of_its_cover(depth, corner, size, seed):
    (x, y), (width, height) = corner, size
    nodes = Nodes(BOX, depth)
    cover = nodes.cover((x, y, x + width, y + height))
    points = np.random.default_rng(seed).uniform((x, y), (x + width, y + height), (200, 2))
    assert set(core(depth).node(points).tolist()) <= cover
    for node in cover:
        left, bottom, right, top = nodes.rectangle(node)
        # A point within rounding of an edge belongs to either side, by the same arithmetic on both ends.
        inside = (
            left - ROUNDING <= x + width
            and right + ROUNDING >= x
            and bottom - ROUNDING <= y + height
            and top + ROUNDING >= y
        )
        edge = left == BOX[0] or right == BOX[2] or bottom == BOX[1] or top == BOX[3]
        assert inside or edge, "a node that the rectangle does not touch"


@given(depths, st.data())
def test_a_node_has_the_middle_of_its_rectangle(depth, data):
    nodes = Nodes(BOX, depth)
    node = data.draw(st.integers(0, nodes.count - 1))
    left, bottom, right, top = nodes.rectangle(node)
    middle = np.array([[(left + right) / 2, (bottom + top) / 2]])
    assert core(depth).node(middle).tolist() == [node]
    assert nodes.cover((*middle[0], *middle[0])) == {node}


def test_the_whole_plane_is_covered_by_all_nodes():
    assert Nodes(BOX, 3).cover((-math.inf, -math.inf, math.inf, math.inf)) == frozenset(range(64))


@given(depths, st.data())
def test_merged_paths_have_just_these_nodes(depth, data):
    nodes = Nodes(BOX, depth)
    wanted = data.draw(st.sets(st.integers(0, nodes.count - 1)) | st.just(set(range(nodes.count))))
    paths = nodes.merged(wanted)
    below = [node for node in range(nodes.count) for path in paths if nodes.path(node)[: len(path)] == path]
    assert sorted(below) == sorted(wanted), "each of them, once"
    assert len(paths) <= max(len(wanted), 1)


def test_four_quarters_are_one_subscription():
    nodes = Nodes(BOX, 3)
    assert nodes.merged(range(64)) == {()}
    assert nodes.merged([*range(16), 16]) == {(0,), (1, 0, 0)}


def test_a_node_s_path_is_its_key():
    keys = Keys("w")
    assert keys.region(2, (0, 3, 1)) == "kuglice/w/region/2/0/3/1"
    assert keys.regions(0, ()) == "kuglice/w/region/0/**"
    assert Keys.node_of("kuglice/w/region/2/0/3/1") == (0, 3, 1)
    with pytest.raises(ProtocolError, match="path of 0, 1, 2 or 3"):
        Keys.node_of("kuglice/w/region/2/0/4")
