"""`kuglice router`: what it refuses."""

import re

import pytest

from e2e.processes import free_endpoint
from kuglice.cli.router import router
from kuglice.errors import NetworkError, ProtocolError
from kuglice.protocol import host_and_port


@pytest.mark.parametrize(
    ("listen", "connect"),
    [
        ("tcp/127.0.0.1:{}", "tcp/127.0.0.1:{}"),
        ("tcp/0.0.0.0:{}", "tcp/localhost:{}"),
        ("tcp+udp/127.0.0.1:{}", "tcp/127.0.0.1:{}"),
        ("tcp+udp/0.0.0.0:{}", "tcp+udp/127.0.0.1:{}"),
    ],
)
def test_a_router_that_would_connect_to_itself_is_refused_by_whatever_name(listen, connect):
    _, port = host_and_port(free_endpoint())
    words = f"whoever listens on {re.escape(connect.format(port))}, .* is the router itself"
    with pytest.raises(NetworkError, match=words):
        router(listen=[listen.format(port)], connect=[connect.format(port)], insecure=True)


def test_what_is_no_endpoint_is_refused_on_either_side():
    with pytest.raises(ProtocolError, match="endpoint '7448'"):
        router(listen=["7448"])
    with pytest.raises(ProtocolError, match="endpoint '7447'"):
        router(connect=["7447"])
