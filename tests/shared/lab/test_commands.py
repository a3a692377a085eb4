"""`kuglice bench` and `kuglice chart`, small ones, from the command line to the files."""

from __future__ import annotations

import csv
import json
import xml.etree.ElementTree as ET

import pytest
from PIL import Image

from kuglice.cli import main
from kuglice.lab.rows import read_csv


def run(*arguments) -> None:
    with pytest.raises(SystemExit) as end:
        main(list(map(str, arguments)))
    assert not end.value.code, end.value.code


@pytest.fixture(scope="module")
def charts(tmp_path_factory):
    out = tmp_path_factory.mktemp("charts")
    run("chart", "--quick", "--repeats", 1, "--only", "loops", "--only", "orbit", "--out", out)
    return out


class TestChart:
    @pytest.mark.parametrize("name", ["loops", "work_precision_orbit"])
    def test_each_is_a_picture_twice_and_the_rows_that_it_was_drawn_from(self, charts, name):
        with Image.open(charts / f"{name}.png") as picture:
            assert picture.width > 1000
            assert len(picture.convert("RGB").getcolors(1 << 20) or []) > 50
        assert ET.parse(charts / f"{name}.svg").getroot().tag.endswith("svg")
        assert len(read_csv(charts / f"{name}.csv")) > 10

    def test_files_say_who_measured(self, charts):
        assert (charts / "loops.csv").read_text().startswith("# ")
        svg = (charts / "loops.svg").read_text()
        for part in ("cores", "kuglice", "UTC", "repeats", "seeds"):
            assert part in svg, part

    def test_work_precision_has_a_row_per_method_and_tick(self, charts):
        rows = read_csv(charts / "work_precision_orbit.csv")
        found = {(row["method"], row["tick_rate"]) for row in rows}
        assert len(found) == len(rows)
        assert {"rk4 x overlap", "verlet x event"} <= {method for method, _ in found}
        assert all(row["cost"] > 0 and row["position_error"] > 0 for row in rows)

    def test_the_order_of_convergence_is_seen_in_it(self, charts):
        rows = read_csv(charts / "work_precision_orbit.csv")
        for method, order in (("verlet x overlap", 2), ("rk4 x overlap", 4)):
            error = {row["tick_rate"]: row["position_error"] for row in rows if row["method"] == method}
            assert error[30] / error[120] == pytest.approx(4**order, rel=0.5)

    def test_loops_of_fixed_steps_do_not_depend_on_frames(self, charts):
        spread = {}
        for row in read_csv(charts / "loops.csv"):
            if row["kind"] == "spread":
                spread.setdefault(row["loop"], []).append(row["value"])
        assert set(spread["fixed"]) == set(spread["interpolated"]) == {0}
        assert max(spread["variable"]) > 1

    def test_what_cannot_run_is_named_with_the_reason(self, tmp_path, capfd):
        run("chart", "--quick", "--repeats", 1, "--only", "orbit", "--out", tmp_path)
        assert "without pymunk: it has no force 'attractor'" in capfd.readouterr().err

    def test_any_scene_has_a_diagram(self, tmp_path, capfd):
        run("chart", "gas:n=20", "--quick", "--repeats", 1, "--no-peers", "--out", tmp_path)
        assert (tmp_path / "work_precision_gas.png").exists()
        assert str(tmp_path / "work_precision_gas.csv") in capfd.readouterr().out


class TestBench:
    @pytest.fixture
    def out(self, tmp_path, capfd):
        run("bench", "--quick", "--repeats", 2, "--case", "gas 100", "--out", tmp_path, "--json")
        self.printed = json.loads(capfd.readouterr().out)
        return tmp_path

    def test_json_csv_and_stdout_hold_the_same_figures(self, out):
        assert json.loads((out / "bench.json").read_text()) == self.printed
        lines = [line for line in (out / "bench.csv").read_text().splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        assert [float(row["minimum"]) for row in rows] == [row["minimum"] for row in self.printed["rows"]]

    def test_rows_are_complete(self, out):
        assert {"processor", "cores", "versions", "flags", "date"} <= set(self.printed["machine"])
        assert "rustc 1." in self.printed["machine"]["flags"]
        for row in self.printed["rows"]:
            assert 0 < row["minimum"] <= row["median"]
            assert row["repeats"] == 2
        assert [row["contender"] for row in self.printed["rows"]] == ["overlap", "backtrack", "event"]

    def test_an_unknown_case_is_refused(self, tmp_path):
        with pytest.raises(SystemExit) as refused:
            main(["bench", "--case", "nothing", "--out", str(tmp_path)])
        assert refused.value.code == 2
