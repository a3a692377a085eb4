"""Names become single chunks of keys and come back from them."""

from __future__ import annotations

import pytest
import zenoh
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import ProtocolError
from kuglice.protocol import Keys

names = st.from_regex(r"[A-Za-z0-9][A-Za-z0-9_-]{0,31}", fullmatch=True)


@given(names, names)
def test_a_client_is_known_by_its_key(world, client):
    keys = Keys(world)
    for key in (keys.input(client, "s1"), keys.client(client, "s1")):
        assert Keys.client_of(key) == (client, "s1")
        assert Keys.world_of(key) == world


@given(names, names)
def test_the_servers_subscription_covers_every_client_and_nothing_else(world, client):
    keys = Keys(world)
    assert zenoh.KeyExpr(keys.inputs).includes(keys.input(client, "s1"))
    assert zenoh.KeyExpr(keys.clients).includes(keys.client(client, "s1"))
    assert not zenoh.KeyExpr(keys.inputs).intersects(keys.tick)


@pytest.mark.parametrize("name", ["", "*", "**", "a/b", "a b", "-a", "$*", "x" * 33, "ž"])
def test_a_name_that_is_no_single_chunk_is_refused(name):
    with pytest.raises(ProtocolError, match="must be 1 to 32 letters"):
        Keys(name)
    with pytest.raises(ProtocolError, match="must be 1 to 32 letters"):
        Keys("arena").input(name, "s1")
