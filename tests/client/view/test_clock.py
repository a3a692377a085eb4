"""The tick that a view shows: smooth over jitter, and never far beyond what was told."""

from __future__ import annotations

import random

from kuglice_client.view.clock import ViewClock


def clock() -> ViewClock:
    return ViewClock(rate=60.0, tick=600, now=10.0)


def test_it_shows_the_tick_of_the_earliest_arrivals_whatever_the_jitter():
    made, shown = clock(), []
    noise = random.Random(3)
    for turn in range(1, 100):
        late = 0.0 if turn % 10 == 1 else noise.uniform(0.0, 0.05)
        now = 10.0 + 0.1 * turn + late
        made.heard(600 + 6 * turn, now)
        shown.append(made.target(now) - 60 * now)
    assert max(shown) - min(shown) < 1e-6


def test_it_goes_on_between_news_but_not_for_long():
    made = clock()
    made.heard(606, 10.1)
    assert round(made.target(10.2), 6) == 612
    assert made.target(11.0) == made.target(20.0) == 606 + 15


def test_it_goes_on_for_longer_where_news_are_rare():
    made = clock()
    made.heard(696, 11.6)
    assert round(made.target(13.0), 6) == 780
    assert made.target(60.0) == 696 + 2 * 96


def test_a_server_that_cannot_keep_its_rate_is_followed():
    made = clock()
    for turn in range(1, 50):
        made.heard(600 + 6 * turn, 10.0 + turn)
        assert 600 + 6 * turn <= made.target(10.5 + turn) <= 600 + 6 * turn + 15


def test_it_never_goes_back():
    made = clock()
    before = made.target(10.2)
    made.heard(601, 10.3)
    assert made.target(10.3) == max(before, made.target(10.3))
