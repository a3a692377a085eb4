"""Rows for people: whatever the width, every figure is there in full."""

from __future__ import annotations

import json

import pytest

from kuglice.cli import rows
from kuglice.cli.rows import print_rows

NARROW = [{"scene": f"gas:n={count}", "balls": count} for count in (100, 1000)]
BROAD = [
    {"scene": f"gas:n={10**power}", **{f"figure_{index}": 10**power * 1000 + index for index in range(20)}}
    for power in range(2, 9)
]


def figures(table: list[dict[str, object]]) -> set[str]:
    return {f"{value:,}" if isinstance(value, int) else str(value) for row in table for value in row.values()}


def words(text: str) -> list[str]:
    return "".join(" " if letter in "│┃" else letter for letter in text).split()


def test_what_fits_has_a_row_for_each_row(capsys):
    print_rows("Gases", NARROW, as_json=False)
    lines = capsys.readouterr().out.splitlines()
    assert [words(line) for line in lines if "gas:" in line] == [
        ["gas:n=100", "100"],
        ["gas:n=1000", "1,000"],
    ]


@pytest.mark.parametrize("width", [60, 80, 160])
def test_what_is_too_wide_is_turned_and_nothing_is_cut(capsys, monkeypatch, width):
    monkeypatch.setattr(rows, "WIDE", width)
    print_rows("Gases", BROAD, as_json=False)
    out = capsys.readouterr().out
    assert max(map(len, out.splitlines())) <= width
    assert figures(BROAD) <= set(words(out))
    assert set(BROAD[0]) <= set(words(out))
    assert out.count("Gases") == 1


def test_headings_and_figures_of_what_is_turned_belong_together(capsys, monkeypatch):
    monkeypatch.setattr(rows, "WIDE", 60)
    print_rows("Gases", BROAD, as_json=False)
    told: dict[str, list[str]] = {}
    for line in capsys.readouterr().out.splitlines():
        heading, *values = words(line) or [""]
        told.setdefault(heading, []).extend(values)
    for heading in BROAD[0]:
        assert told[heading] == [f"{row[heading]:,}" if heading != "scene" else row[heading] for row in BROAD]


def test_programs_get_the_rows_as_they_are(capsys):
    print_rows("Gases", BROAD, as_json=True)
    assert json.loads(capsys.readouterr().out) == BROAD
