"""Which endpoints only this machine can reach, and what a failed session says."""

from __future__ import annotations

import socket

import pytest

from kuglice import protocol
from kuglice.errors import ProtocolError
from kuglice.protocol import (
    client_configuration,
    close_session,
    is_loopback,
    open_session,
    server_configuration,
)


@pytest.mark.parametrize(
    "endpoint",
    ["tcp/127.0.0.1:7447", "tcp/127.8.9.10:1", "tcp/localhost:7447", "tcp/[::1]:7447", "udp/127.0.0.1:1"],
)
def test_loopback(endpoint):
    assert is_loopback(endpoint)


@pytest.mark.parametrize(
    "endpoint",
    ["tcp/0.0.0.0:7447", "tcp/[::]:7447", "tcp/192.168.1.5:7447", "tcp/example.org:7447", "tls/10.0.0.1:1"],
)
def test_reachable_by_others(endpoint):
    assert not is_loopback(endpoint)


@pytest.mark.parametrize(
    "endpoint", ["", "tcp", "127.0.0.1:7447", "tcp/127.0.0.1", "tcp/127.0.0.1:x", "tcp/h:99999"]
)
def test_no_endpoint(endpoint):
    with pytest.raises(ProtocolError, match="endpoint"):
        is_loopback(endpoint)


def test_nobody_scouts_and_nothing_is_shared():
    for configuration in (
        server_configuration(listen=["tcp/127.0.0.1:1"], connect=[]),
        server_configuration(listen=[], connect=["tcp/127.0.0.1:1"]),
        client_configuration(["tcp/127.0.0.1:1"], timeout=1),
    ):
        assert configuration["scouting"] == {"multicast": {"enabled": False}, "gossip": {"enabled": False}}
        assert configuration["transport"]["shared_memory"] == {"enabled": False}


def test_every_kind_of_message_that_goes_as_a_whole_is_taken_in():
    kinds = [
        getattr(protocol, name)
        for name in protocol.__all__
        if isinstance(getattr(protocol, name), type) and hasattr(getattr(protocol, name), "max_bytes")
    ]
    larger = {kind for kind in kinds if kind.max_bytes > protocol.MAX_WHOLE_BYTES}
    assert larger == {protocol.About, protocol.History}, "which go in parts, as states do"
    assert protocol.Part in kinds


def test_a_server_with_an_address_is_a_router_and_one_without_is_a_client():
    assert server_configuration(listen=["tcp/127.0.0.1:1"], connect=[])["mode"] == "router"
    assert server_configuration(listen=[], connect=["tcp/127.0.0.1:1"])["mode"] == "client"


def test_a_taken_port_is_named():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        endpoint = f"tcp/127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(ProtocolError, match=f"cannot listen on {endpoint}"):
            open_session(server_configuration(listen=[endpoint], connect=[]))


def test_a_session_that_nobody_answers_is_given_up():
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{unused.getsockname()[1]}"
        with pytest.raises(ProtocolError, match=f"cannot connect to {endpoint}"):
            open_session(client_configuration([endpoint], timeout=0.2))


def test_closing_says_whether_it_is_done():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    session = open_session(server_configuration(listen=[f"tcp/127.0.0.1:{port}"], connect=[]))
    publisher = session.declare_publisher("kuglice/x/tick")
    assert close_session(session, [publisher])
    assert session.is_closed()
