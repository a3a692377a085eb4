"""Parts that charts are put together from."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.lab.cost_growth.fit import crossing, exponent
from kuglice.lab.figures.labels import LINE, _apart
from kuglice.lab.rows import read_csv, where, write_csv
from kuglice.lab.stability_maps import oscillator, tunnelling
from kuglice.lab.stopwatch import Timing, race
from kuglice.lab.work_precision.front import front

POINTS = st.lists(st.tuples(st.floats(1e-9, 1e9), st.floats(1e-9, 1e9)), min_size=1)


class TestFront:
    @given(POINTS)
    def test_nothing_beats_a_point_of_it(self, points):
        for error, cost in front(points):
            assert not any((e <= error and c < cost) or (e < error and c <= cost) for e, c in points)

    @given(POINTS)
    def test_something_of_it_beats_every_other_point(self, points):
        best = front(points)
        assert all(any(e <= error and c <= cost for e, c in best) for error, cost in points)


class TestLabels:
    @given(st.lists(st.floats(0, 1000), min_size=1, max_size=30))
    def test_end_up_a_line_apart_and_in_order(self, heights):
        placed = _apart(sorted(heights))
        assert all(above - below >= LINE - 1e-6 for below, above in pairwise(placed))

    def test_stay_where_there_is_room(self):
        assert _apart([0.0, 100.0, 200.0]) == [0.0, 100.0, 200.0]


class TestFits:
    def test_exponent(self):
        assert exponent([1, 10, 100], [2, 200, 20000]) == pytest.approx(2.0)
        assert math.isnan(exponent([1], [1]))

    def test_crossing_of_power_laws(self):
        x = [1.0, 10.0, 100.0]
        assert crossing(x, x, [30.0, 30.0, 30.0]) == pytest.approx(30.0)
        assert crossing(x, [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]) is None


class TestRows:
    def test_come_back_as_they_were(self, tmp_path):
        rows = [{"name": "a, b", "count": 3, "value": 0.1}, {"name": "c", "other": 1e-300}]
        write_csv(tmp_path / "rows.csv", rows, ["a machine"])
        assert read_csv(tmp_path / "rows.csv") == rows
        assert where(rows, name="c") == [rows[1]]


class TestStopwatch:
    def test_contenders_take_turns(self):
        order = []
        timings = race({name: lambda name=name: lambda: order.append(name) for name in "ab"}, 3)
        assert "".join(order) == "ababab"
        assert timings["a"].repeats == 3

    def test_minimum_and_median(self):
        timing = Timing((3.0, 1.0, 2.0))
        assert (timing.minimum, timing.median) == (1.0, 2.0)


class TestMaps:
    @pytest.mark.parametrize("integrator", ["euler", "rk4"])
    @pytest.mark.parametrize("step", [0.05, 0.5, 1.3])
    def test_energy_on_a_spring_grows_as_theory_says(self, integrator, step):
        assert oscillator.growth(integrator, step) == pytest.approx(
            oscillator.theory(integrator, step), rel=1e-6
        )

    @pytest.mark.parametrize("integrator", oscillator.BOUNDARY)
    def test_boundaries_are_where_theory_has_them(self, integrator):
        boundary = oscillator.BOUNDARY[integrator]
        assert oscillator.growth(integrator, 0.97 * boundary) < 1e3
        assert oscillator.growth(integrator, 1.03 * boundary) > 1e6

    @pytest.mark.parametrize("move", [1.0, 3.0, 10.0])
    def test_overlap_tunnels_as_theory_says_and_event_never(self, move):
        deviation = math.sqrt(0.25 / tunnelling.PAIRS)
        assert tunnelling.share("overlap", move) == pytest.approx(tunnelling.theory(move), abs=4 * deviation)
        assert tunnelling.share("event", move) == 0.0
