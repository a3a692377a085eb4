"""What a user is told of an address that nobody answers at, or that is taken: in the user's words, with a way out."""

import socket

import pytest

from kuglice.errors import ProtocolError
from kuglice.protocol import (
    check_endpoints,
    client_configuration,
    host_and_port,
    open_session,
    server_configuration,
)


def taken_port() -> socket.socket:
    taken = socket.socket()
    taken.bind(("127.0.0.1", 0))
    taken.listen()
    return taken


@pytest.mark.parametrize("links", ["tcp", "tcp+udp"])
def test_nobody_there_is_told_with_the_endpoint_as_it_was_written_and_what_to_do(links):
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        endpoint = f"{links}/127.0.0.1:{unused.getsockname()[1]}"
        with pytest.raises(ProtocolError) as told:
            open_session(client_configuration([endpoint], timeout=0.2))
    assert str(told.value) == (
        f"cannot connect to {endpoint}: nobody answers there; start a server there (`kuglice server SCENE`), or say "
        "with --connect where one, or a router, runs"
    )


def test_a_host_without_an_address_is_named():
    # A name that may never be given to anybody (RFC 6761).
    with pytest.raises(ProtocolError) as told:
        open_session(client_configuration(["tcp+udp/nobody.invalid:7447"], timeout=0.2))
    assert str(told.value) == (
        "cannot connect to tcp+udp/nobody.invalid:7447: no address is known of a host nobody.invalid"
    )


@pytest.mark.parametrize("links", ["tcp", "tcp+udp"])
def test_a_port_that_is_taken_is_told_with_what_to_do(links):
    with taken_port() as taken:
        endpoint = f"{links}/127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(ProtocolError) as told:
            open_session(server_configuration(listen=[endpoint], connect=["tcp/127.0.0.1:9"]))
    assert str(told.value) == (
        f"cannot listen on {endpoint}: address already in use; end the program that has it, or --listen elsewhere"
    )


@pytest.mark.parametrize(
    ("endpoint", "told"),
    [
        ("127.0.0.1:7447", "must look like tcp\\+udp/127.0.0.1:7447"),
        ("nonsense", "must look like tcp\\+udp/127.0.0.1:7447"),
        ("http/127.0.0.1:80", "'http' must be one of tcp, tcp\\+udp"),
        ("tcp/127.0.0.1:99999", "a port of 0 to 65535"),
        ("tcp/:7447", "must have a host"),
        ("tcp/127.0.0.1", "a port of 0 to 65535"),
    ],
)
def test_what_is_no_endpoint_is_refused_before_anything_is_tried(endpoint, told):
    with pytest.raises(ProtocolError, match=f"endpoint '{endpoint}': .*{told}"):
        check_endpoints(["tcp/127.0.0.1:1", endpoint])


def test_an_endpoint_is_taken_apart():
    assert host_and_port("tcp/[::1]:7447") == ("::1", 7447)
    assert host_and_port("tcp+udp/kuglice.example:80") == ("kuglice.example", 80)
