"""Rows as CSV: what is remarked about them comes first and is no row."""

from __future__ import annotations

from kuglice.lab.rows import read_csv, write_csv


def test_a_remark_of_several_lines_is_no_row(tmp_path):
    path = tmp_path / "figures.csv"
    write_csv(path, [{"case": "one", "minimum": 1.5}], ["a machine", "left out: it said\nwhy, in two lines"])
    assert read_csv(path) == [{"case": "one", "minimum": 1.5}]
