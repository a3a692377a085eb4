"""Large things arrive whole, in whatever order their parts come, or not at all."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import ProtocolError
from kuglice.protocol import PART_BYTES, Assembly, Part, Whole, decode, encode, split

BATCH = 65_535


@given(st.integers(0, 4 * PART_BYTES), st.permutations(range(4)))
def test_parts_in_any_order_make_the_whole_again(size, order):
    data = np.arange(size // 4 + 1, dtype="<u4").tobytes()[:size]
    parts = [decode(encode(part), Part) for part in split(data, of="snapshot", epoch=1, tick=60)]
    parts = [parts[index] for index in order if index < len(parts)]
    assembly = Assembly()
    wholes = [assembly.add(part) for part in parts]
    assert wholes[:-1] == [None] * (len(parts) - 1)
    assert wholes[-1] == Whole("snapshot", 1, 60, data)


@given(st.integers(0, 3 * PART_BYTES))
def test_every_part_fits_into_one_batch(size):
    parts = list(split(bytes(size), of="about", epoch=2**64 - 1, tick=2**62 - 1))
    assert all(len(encode(part)) <= BATCH for part in parts)
    assert sum(len(part.data) for part in parts) == size


def test_a_part_that_comes_twice_counts_once():
    first, second = split(bytes(PART_BYTES + 1), of="snapshot", epoch=1, tick=1)
    assembly = Assembly()
    assert assembly.add(first) is None
    assert assembly.add(first) is None
    assert assembly.add(second) is not None


def test_an_incomplete_pile_gives_way_to_newer_ones():
    assembly = Assembly(piles=2)
    for tick in range(10):
        assembly.add(next(split(bytes(PART_BYTES + 1), of="snapshot", epoch=1, tick=tick)))
    assert assembly.given_up == 8


def test_parts_of_different_epochs_are_not_mixed():
    one, _ = split(b"a" * (PART_BYTES + 1), of="snapshot", epoch=1, tick=1)
    _, other = split(b"b" * (PART_BYTES + 1), of="snapshot", epoch=2, tick=1)
    assembly = Assembly()
    assert assembly.add(one) is None
    assert assembly.add(other) is None


def test_what_would_be_too_large_is_refused_at_its_first_part():
    part = next(split(bytes(3 * PART_BYTES), of="snapshot", epoch=1, tick=1))
    with pytest.raises(ProtocolError, match="at most 100000 allowed"):
        Assembly(max_bytes=100_000).add(part)


def test_parts_that_disagree_about_the_size_are_refused():
    one, _ = split(bytes(PART_BYTES + 1), of="snapshot", epoch=1, tick=1)
    _, other = split(bytes(PART_BYTES + 2), of="snapshot", epoch=1, tick=1)
    assembly = Assembly()
    assembly.add(one)
    with pytest.raises(ProtocolError, match="a part says"):
        assembly.add(other)


@pytest.mark.parametrize(
    ("index", "count", "size", "data", "message"),
    [
        (1, 1, 5, b"12345", "index 1: must be below count 1"),
        (0, 9, 5, b"12345", "count 9: 5 bytes do not come in that many parts"),
        (0, 1, 5, b"123", "3 bytes in part 0 of 1, not 5"),
    ],
)
def test_a_part_that_cannot_be_is_refused(index, count, size, data, message):
    with pytest.raises(ValueError, match=message):
        Part(epoch=1, of="snapshot", tick=0, index=index, count=count, size=size, data=data)
