"""Targets are judged by the figures of a run: which figures, in which direction, and what if they are missing."""

from __future__ import annotations

import pytest

from kuglice.lab.bench import cases, judged
from kuglice.lab.bench.targets import TARGETS


def row(case, contender, minimum, median=None):
    return {"case": case, "contender": contender, "minimum": minimum, "median": median or minimum}


def verdict(what, rows):
    found, _ = judged(rows)
    return next(each for each in found if each["contender"] == what)


def test_every_figure_that_a_target_asks_for_is_of_a_case_that_there_is():
    names = {case.name for case in cases(peers=False, quick=False, repeats=1)}
    asked = set()

    def of(case, contender):
        asked.add(case)
        return 1.0

    for target in TARGETS:
        target.figure(of)
    assert asked <= names


@pytest.mark.parametrize(("nanoseconds", "expected"), [(19.0, "met"), (20.0, "met"), (20.5, "missed")])
def test_at_most(nanoseconds, expected):
    rows = [row("gas 10,000", "overlap", nanoseconds, 99.0)]
    found = verdict("gas 10,000, overlap, 1 thread", rows)
    assert (found["minimum"], found["median"]) == (nanoseconds, 99.0)
    assert (found["target"], found["verdict"]) == ("<= 20", expected)


@pytest.mark.parametrize(("peer", "expected"), [(350.0, "met"), (349.0, "missed")])
def test_at_least_a_ratio_within_the_run(peer, expected):
    rows = [row("gas 10,000", "overlap", 10.0), row("gas 10,000", "pymunk", peer)]
    found = verdict("the same, pymunk / ours", rows)
    assert found["minimum"] == pytest.approx(peer / 10.0)
    assert (found["target"], found["verdict"]) == (">= 35", expected)


def test_what_was_not_measured_is_named_and_not_judged():
    found, missing = judged([row("gas 10,000", "overlap", 10.0)])
    assert [each["contender"] for each in found] == ["gas 10,000, overlap, 1 thread"]
    assert len(missing) == len(TARGETS) - 1
    assert "rain / gas, event" in missing
