"""Where the stream is, by its arrivals: the earliest counts, a server that falls back is seen to, delays are not."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice_client.phase import ARRIVALS, LEAST_ARRIVALS, RISE_SECONDS, Phase

RATE = 60.0


def phase() -> Phase:
    return Phase(rate=RATE, tick=0, now=0.0)


def heard(one: Phase, ticks: range, made: float, delay=lambda _: 0.0) -> float:
    """All of them, from a server that makes `made` per second. When the last one came."""
    now = 0.0
    for tick in ticks:
        now = max(now, tick / made + delay(tick))
        one.heard(tick, now)
    return now


@given(
    delays=st.lists(st.floats(0.0, 0.2), min_size=1, max_size=100),
    later=st.floats(0.0, 1.0),
)
def test_no_delay_puts_it_ahead_of_what_was_made_and_the_least_says_where_it_is(delays, later):
    one = phase()
    for tick, delay in enumerate(delays, 1):
        one.heard(tick, tick / RATE + delay)
    now = len(delays) / RATE + 0.2 + later
    if not one.drift:
        least = min([0.0, *delays])
        assert one.tick(now) == pytest.approx((now - least) * RATE)
        assert one.behind(len(delays), now) == pytest.approx(now - len(delays) / RATE - least)


@pytest.mark.parametrize("made", [57.0, 50.0, 30.0])
def test_of_a_server_that_falls_back_it_says_the_rate(made):
    one = phase()
    now = heard(one, range(1, 600), made)
    assert one.rate == pytest.approx(made)
    assert one.tick(now + 0.1) == pytest.approx(599 + 0.1 * made)
    assert one.late(1.0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_delays_that_vary_are_no_drift(seed):
    vary = random.Random(seed)
    one = phase()
    now = 0.0
    for tick in range(1, 3000):
        now = max(now, tick / RATE + vary.uniform(0.0, 0.06))
        one.heard(tick, now)
        if tick > ARRIVALS // 2:
            assert one.drift == 0.0


def test_a_single_stall_is_none_however_long():
    one = phase()
    for tick in range(1, 1000):
        one.heard(tick, tick / RATE + (0.3 if tick > 500 else 0.0))
        assert one.drift == 0.0


def test_too_little_of_it_is_not_told_from_delays():
    slow = RATE * (1 - 0.9 * RISE_SECONDS / (ARRIVALS / 4 / RATE))
    one = phase()
    heard(one, range(1, 2000), slow)
    assert one.rate == RATE


def test_a_server_that_keeps_its_rate_again_is_soon_taken_at_its_word():
    one = phase()
    heard(one, range(1, 600), 50.0)
    back = 600 / 50.0 - 600 / RATE
    for tick in range(600, 600 + ARRIVALS // 2):
        one.heard(tick, tick / RATE + back)
    assert one.rate == RATE
    assert one.tick(1000 / RATE + back) == pytest.approx(1000)


def test_many_that_come_in_one_moment_and_in_any_order_do_no_harm():
    one = phase()
    ticks = random.Random(1).sample(range(1, 500), 499)
    for tick in ticks:
        one.heard(tick, 9.0)
    assert one.rate == RATE
    assert one.tick(9.0) == pytest.approx(max(ticks[-ARRIVALS:]))


def test_what_is_forgotten_counts_no_more():
    one = phase()
    heard(one, range(1, 600), 50.0)
    assert one.known
    one.forget()
    one.heard(10, 20.0)
    assert (one.rate, one.known) == (RATE, False)
    assert one.tick(20.0) == pytest.approx(10)


def test_messages_that_had_been_queueing_are_forgotten_and_no_others():
    one = phase()
    for tick in range(1, LEAST_ARRIVALS):
        one.heard(tick, tick / RATE + 1.0)
    before = one.late(1.0)
    assert not one.forget_later(LEAST_ARRIVALS, LEAST_ARRIVALS / RATE + 0.98, seconds=0.05)
    assert one.late(1.0) == before > 0.9
    assert one.forget_later(LEAST_ARRIVALS, LEAST_ARRIVALS / RATE + 0.1, seconds=0.05)
    assert one.late(1.0) == 0.0
