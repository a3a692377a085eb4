"""`kuglice view`: a corner of either sign is a corner, and no option."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from kuglice.cli.app import build
from kuglice.errors import JoinError, ProtocolError

NOBODY = ["--connect", "tcp/127.0.0.1:9", "--wait", "0"]


@pytest.mark.parametrize("corner", ["-5,-4,32,18", "-.5,0,32,18", "5,-4,32,18"])
def test_a_corner_below_zero_is_looked_at(corner):
    result = CliRunner().invoke(build(), ["view", corner, "--pan", "-5,0", *NOBODY])
    # Nobody answers there: whoever gets as far as to connect has understood the rest.
    assert isinstance(result.exception, JoinError), result.output


def test_what_is_no_rectangle_and_no_option_is_named():
    result = CliRunner().invoke(build(), ["view", "-5,-4,32", *NOBODY])
    assert isinstance(result.exception, ProtocolError)
    assert str(result.exception) == "view '-5,-4,32': must be four numbers X,Y,WIDTH,HEIGHT"
    for words in (
        ["0,0,32,18", "--conect", "tcp/127.0.0.1:9"],
        ["--conect", "tcp/127.0.0.1:9", "-5,0,32,18"],
    ):
        result = CliRunner().invoke(build(), ["view", *words])
        assert result.exit_code == 2
        assert "No such option: --conect" in result.output
        assert "--connect" in result.output
