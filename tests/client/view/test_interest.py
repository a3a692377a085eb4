"""Which regions a view wants: what covers it, within its budget, the far ones less often first."""

from __future__ import annotations

import itertools

import pytest

from kuglice.errors import ProtocolError
from kuglice.protocol import PACES, Nodes
from kuglice_client.view import ViewSettings, parse_rectangle
from kuglice_client.view.interest import Interest

NODES = Nodes((0.0, 0.0, 80.0, 80.0), 3)
VIEW = (32.0, 32.0, 48.0, 48.0)


def interest(budget: float | None = None) -> Interest:
    made = Interest(NODES, rate=10.0, balls=64 * 10, budget=budget)
    made.choose(VIEW, 10.0)
    return made


def chebyshev(node: int) -> float:
    left, bottom, right, top = NODES.rectangle(node)
    return max(abs((left + right) / 2 - 40), abs((bottom + top) / 2 - 40))


def test_without_a_budget_everything_that_covers_view_and_margin_comes_at_full_pace():
    made = interest()
    assert made.paces == dict.fromkeys(NODES.cover((22.0, 22.0, 58.0, 58.0)), 0)
    assert len(made.paces) == 16
    assert not made.out_of_balance


@pytest.mark.parametrize("budget", [100.0, 1000.0, 3000.0, 7000.0, 12_000.0, 1e6])
def test_a_budget_is_kept_by_slowing_the_far_regions_first(budget):
    made = interest(budget)
    assert made.bytes_per_second <= budget
    pace = {node: made.paces.get(node, PACES) for node in NODES.cover((22, 22, 58, 58))}
    for near, far in itertools.product(pace, pace):
        assert pace[near] <= pace[far] or chebyshev(near) >= chebyshev(far)
    assert made.left_out == list(pace.values()).count(PACES)


def test_what_is_heard_of_sizes_is_taken_into_account():
    made = interest(16_000.0)
    before = made.bytes_per_second
    for node in made.paces:
        for _ in range(50):
            made.note(node, 300)
    assert made.bytes_per_second > 2 * before
    assert made.out_of_balance
    assert made.choose(VIEW, 10.0)
    assert made.bytes_per_second <= 16_000
    assert not made.out_of_balance
    assert any(made.paces.values())


def test_bytes_that_became_free_are_used_again():
    made = interest(8000.0)
    assert any(made.paces.values())
    for node in NODES.cover((22, 22, 58, 58)):
        for _ in range(50):
            made.note(node, 20)
    assert made.out_of_balance
    made.choose(VIEW, 10.0)
    assert not any(made.paces.values())


def test_it_changes_as_the_view_moves():
    made = interest()
    assert not made.choose(VIEW, 10.0)
    assert not made.choose((33.0, 33.0, 47.0, 47.0), 10.0)
    assert made.choose((72.0, 72.0, 90.0, 90.0), 0.0)
    assert made.paces == {63: 0}


def test_a_rectangle_is_given_by_its_corner_and_its_size():
    assert parse_rectangle("1,2,3,4.5") == (1.0, 2.0, 4.0, 6.5)
    for wrong in ("", "1,2,3", "1,2,3,x", "0,0,0,1", "0,0,1,-1", "nan,0,1,1", "0,0,inf,1"):
        with pytest.raises(ProtocolError, match="view"):
            parse_rectangle(wrong)


@pytest.mark.parametrize("wrong", [{"margin": -1.0}, {"margin": float("nan")}, {"budget": 0.0}])
def test_settings_that_cannot_be_are_refused(wrong):
    with pytest.raises(ProtocolError):
        ViewSettings(VIEW, **wrong)


def test_what_comes_into_sight_is_asked_for_at_once_nearest_first_and_then_at_its_pace():
    made = interest(3000.0)
    assert all(made.paces.values()), "on this budget everything is slow"
    told: list[int] = []
    while not made.complete:
        at_once = {node for node, pace in made.asked_for.items() if pace < made.paces[node]}
        assert at_once.isdisjoint(told)
        assert 0 < 100 * len(at_once) <= 0.1 * 3000.0
        later = made.paces.keys() - at_once - set(told)
        assert max(map(chebyshev, at_once)) <= min(map(chebyshev, later), default=80.0)
        assert not made.first_words_came
        for node in at_once:
            made.note(node, 100)
        told += at_once
        assert made.first_words_came
        made.choose(VIEW, 10.0)
    assert made.asked_for == made.paces
    assert not made.first_words_came


def test_what_was_out_of_sight_is_asked_for_at_once_again():
    made = interest(3000.0)
    while not made.complete:
        for node in made.asked_for:
            made.note(node, 100)
        made.choose(VIEW, 10.0)
    made.choose((0.0, 0.0, 8.0, 8.0), 0.0)
    assert made.asked_for == {0: 0}
    made.choose(VIEW, 10.0)
    assert made.asked_for != made.paces


@pytest.mark.parametrize("budget", [20_000.0, 60_000.0])
@pytest.mark.parametrize("speed", [0.0, 20.0, 40.0])
def test_first_words_are_within_the_budget_of_a_view_that_moves(budget, speed):
    """Of 800 bytes a region, told every 0.1 s by a server that hears of a change a round later."""
    nodes = Nodes((0.0, 0.0, 682.0, 384.0), 5)
    made = Interest(nodes, rate=10.0, balls=100_000, budget=budget)
    wanted: dict[int, int] = {}
    waits: list[int] = []
    told_bytes = 0
    before: dict[int, int] = {}
    rounds = 150
    for number in range(rounds):
        x = 50.0 + speed * number / 10
        view = (x, 100.0, x + 64.0, 136.0)
        made.choose(view, 6.0)
        asked, before = before, made.asked_for
        wanted = {node: wanted.get(node, number) for node in made.paces}
        for node, pace in asked.items():
            if (number + node) >> pace != (number - 1 + node) >> pace:
                told_bytes += 800
                made.note(node, 800)
                if node in wanted and wanted[node] >= 0:
                    waits.append(number - wanted[node])
                    wanted[node] = -1
        if number % 5 == 4:
            made.passed(0.5)
    assert told_bytes / (rounds / 10) <= budget
    assert sorted(waits)[len(waits) // 2] <= 5
