"""What a view may look at: any rectangle that balls could be told apart in, and nothing else."""

from __future__ import annotations

import pytest

from kuglice.errors import ProtocolError
from kuglice_client.view import ViewSettings, parse_rectangle


def test_a_rectangle_is_its_corner_and_its_size():
    assert parse_rectangle("-20,-10,64,36") == (-20.0, -10.0, 44.0, 26.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1,2,3", "must be four numbers"),
        ("a,b,c,d", "must be four numbers"),
        ("0,0,0,1", "above 0"),
        ("9,9,-1,5", "view '9,9,-1,5': width and height must be above 0"),
        ("0,0,nan,1", "must be within"),
        ("0,0,1e300,1e300", r"must be within 1e\+12 m"),
        ("-inf,0,1,1", "must be within"),
    ],
)
def test_what_is_none_is_refused_with_its_bound(text, words):
    with pytest.raises(ProtocolError, match=words):
        parse_rectangle(text)


@pytest.mark.parametrize(("setting", "value"), [("margin", -1.0), ("budget", 0.0)])
def test_numbers_that_cannot_be_are_refused_by_name(setting, value):
    with pytest.raises(ProtocolError, match=f"{setting} {value:g}: must be"):
        ViewSettings((0.0, 0.0, 1.0, 1.0), **{setting: value})
