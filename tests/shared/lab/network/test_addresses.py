"""Where the proxy listens and relays to: an endpoint as everywhere, or a bare host and port; and never to itself."""

import pytest

from kuglice.errors import NetworkError
from kuglice.lab.cli.proxy import proxy
from kuglice.lab.network.addresses import address
from kuglice.lab.network.conditions import Conditions


@pytest.mark.parametrize("text", ["127.0.0.1:7447", "tcp/127.0.0.1:7447", "tcp+udp/127.0.0.1:7447"])
def test_one_address_in_every_way_of_writing(text):
    assert address(text) == ("127.0.0.1", 7447)
    assert address(text.replace("127.0.0.1", "[::1]")) == ("::1", 7447)


@pytest.mark.parametrize(
    "text", ["abc", ":7447", "127.0.0.1:0", "127.0.0.1:65536", "tcp/127.0.0.1", "http/a:80"]
)
def test_what_is_none_is_told_with_an_example(text):
    with pytest.raises(NetworkError, match=f"address '{text}': .* like tcp\\+udp/127.0.0.1:7447"):
        address(text)


def test_a_proxy_of_itself_is_refused():
    with pytest.raises(
        NetworkError, match=r"proxy: listens on 127.0.0.1:7448 and relays to it, which is itself"
    ):
        proxy("127.0.0.1:7448", "tcp/127.0.0.1:7448")


def test_a_round_trip_out_of_bounds_is_told_in_the_unit_of_its_option():
    with pytest.raises(NetworkError, match="round trip -5 ms: must be 0 to 60000 ms"):
        proxy(round_trip=-5.0)
    with pytest.raises(NetworkError, match="round trip 60500 ms"):
        Conditions(round_trip=60.5)
