"""`kuglice bench network`, cells through a proxy: real processes from the command line to the files."""

from __future__ import annotations

import json

import pytest

from kuglice.cli import main
from kuglice.lab.network import cell
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.table import cells
from kuglice.lab.rows import read_csv


def test_cells_are_played_cut_and_judged(tmp_path, capfd, monkeypatch):
    # How soon who was cut off recovers is not asked here.
    monkeypatch.setattr(cell, "CUT_SECONDS", 2.0)
    monkeypatch.setattr(cell, "AFTER_CUT_SECONDS", 3.0)
    words = ["bench", "network", "--quick", "--link", "proxy", "--seconds", "2", "--json"]
    with pytest.raises(SystemExit) as end:
        main([*words, "--scene", "one acts", "--out", str(tmp_path)])
    assert not end.value.code
    rows = json.loads(capfd.readouterr().out)["rows"]
    assert [row["protocols"] for row in rows] == ["tcp+udp", "tcp"]
    for row in rows:
        assert (row["desyncs"], row["hashes_equal"]) == (0, 1)
        assert (row["desyncs_after_cut"], row["hashes_equal_after_cut"]) == (0, 1)
        assert row["inputs"] > 0
        assert row["own_screen_ms"] > 0
        assert row["other_screen_ms"] > 0, "the onlooker saw them too"
        assert row["payload_down"] > row["payload_up"] > 0
        assert row["wire_up"] == "", "a proxy sees no headers"
    again = read_csv(tmp_path / "network.csv")
    assert [row["payload_down"] for row in again] == [row["payload_down"] for row in rows]
    assert "arena, one acts" in (tmp_path / "network.md").read_text()


def test_the_table_has_every_scene_under_every_condition():
    every = cells(quick=False, seconds=1, link="auto")
    assert {cell.subject.name for cell in every} == {"arena", "arena, one acts", "rain 1,000", "rain 10,000"}
    conditions = {cell.conditions for cell in every}
    assert Conditions(round_trip=0.3, jitter=0.2, loss=0.02) in conditions
    assert len(every) == 4 * 2 * len(conditions) == 56


def test_an_unknown_scene_is_refused(tmp_path):
    with pytest.raises(SystemExit) as refused:
        main(["bench", "network", "--scene", "nothing", "--out", str(tmp_path)])
    assert refused.value.code == 2
