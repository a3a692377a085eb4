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


@pytest.mark.parametrize("option", ["listen", "connect"])
def test_a_host_without_an_address_is_named_at_once(option):
    # A name that may never be given to anybody (RFC 6761).
    told = re.escape("endpoint 'tcp/nobody.invalid:7447': no address is known of a host nobody.invalid")
    endpoints = {"listen": [free_endpoint()], option: ["tcp/nobody.invalid:7447"]}
    with pytest.raises(ProtocolError, match=told):
        router(**endpoints, insecure=True)
