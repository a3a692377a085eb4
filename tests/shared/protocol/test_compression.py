"""What is compressed comes back to the last bit, and nothing else comes back at all."""

from __future__ import annotations

import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice import World, scenes
from kuglice.errors import ProtocolError
from kuglice.protocol import compress, decompress

BOUND = 1 << 20


@given(st.binary(max_size=300), st.booleans())
def test_every_string_of_bytes_comes_back(data, numbers):
    assert decompress(compress(data, numbers=numbers), max_bytes=BOUND) == data


@pytest.mark.parametrize("name", ["gas:n=1000", "rain:n=1000", "arena"])
def test_a_state_shrinks_by_a_fifth_and_more(name):
    world = World(scenes.find(name))
    world.run(60)
    state = world.snapshot()
    packed = compress(state, numbers=True)
    assert decompress(packed, max_bytes=BOUND) == state
    assert len(packed) < 0.8 * len(state)


def test_what_does_not_shrink_costs_one_byte():
    noise = zlib.compress(bytes(range(256)) * 9, 9)
    assert len(compress(noise)) <= len(noise) + 1


@pytest.mark.parametrize("numbers", [False, True])
def test_a_bomb_is_not_unpacked(numbers):
    with pytest.raises(ProtocolError, match=f"at most {BOUND} allowed"):
        decompress(compress(bytes(64 * BOUND), numbers=numbers), max_bytes=BOUND)
    assert len(decompress(compress(bytes(BOUND), numbers=numbers), max_bytes=BOUND)) == BOUND


@pytest.mark.parametrize("data", [b"", b"\x03abc", b"\x01abc", b"\x02" + zlib.compress(b"a" * 99)[:-3]])
def test_anything_else_is_refused(data):
    with pytest.raises(ProtocolError, match="compressed data: "):
        decompress(data, max_bytes=BOUND)
