"""What a server refuses to be started with."""

from __future__ import annotations

import pytest

from kuglice.errors import ProtocolError
from kuglice_server import ServerSettings


@pytest.mark.parametrize("endpoint", ["tcp/0.0.0.0:7447", "tcp/[::]:7447", "tcp/192.168.1.2:7447"])
def test_an_address_that_others_reach_needs_insecure(endpoint):
    with pytest.raises(ProtocolError, match="--insecure"):
        ServerSettings(world="w", listen=(endpoint,))
    assert ServerSettings(world="w", listen=(endpoint,), insecure=True).listen == (endpoint,)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"listen": ()}, "none to listen on"),
        ({"listen": ("7447",)}, "must look like"),
        ({"snapshot_every": 0}, "snapshot-every 0: must be at least 1"),
        ({"rate": 0.0}, "rate 0: must be at least 0.001"),
        ({"rate": float("nan")}, "rate nan"),
        ({"rate": 1e9}, "at most 10000"),
        ({"region_rate": 5e-324}, "region-rate 5e-324: must be at least 0.001"),
        ({"region_rate": 1001.0}, "at most 1000"),
    ],
)
def test_values_out_of_bounds(wrong, message):
    with pytest.raises(ProtocolError, match=message):
        ServerSettings(world="w", **wrong)
