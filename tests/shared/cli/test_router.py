"""`kuglice router`: what it refuses."""

import pytest

from kuglice.cli.router import router
from kuglice.errors import NetworkError, ProtocolError


@pytest.mark.parametrize("own", ["tcp/127.0.0.1:7448", "tcp+udp/127.0.0.1:7448"])
def test_a_router_that_would_connect_to_itself_is_refused(own):
    with pytest.raises(
        NetworkError, match=r"router: listens on tcp/127.0.0.1:7448 and connects to it, which is itself"
    ):
        router(listen=[own], connect=["tcp/127.0.0.1:7448"])


def test_what_is_no_endpoint_is_refused_on_either_side():
    with pytest.raises(ProtocolError, match="endpoint '7448'"):
        router(listen=["7448"])
    with pytest.raises(ProtocolError, match="endpoint '7447'"):
        router(connect=["7447"])
