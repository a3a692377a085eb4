"""The clock of a client, against a server and a link that are simulated here."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice_client.clock import SLIP, Clock

RATE = 60.0


def simulate(
    delays, *, up: float = 0.0, clock: Clock | None = None, seconds: float = 20.0
) -> tuple[Clock, list[int]]:
    """A server that ticks evenly; message n takes delays(n) to come, an input `up` seconds to go.

    Returns the clock and how early each input came, one input for every client tick.
    """
    clock = clock or Clock(rate=RATE, tick=0, now=0.0, round_trip=delays(0) + up)
    arrivals = sorted((n / RATE + delays(n), n + 1) for n in range(int(seconds * RATE)))
    early: list[int] = []
    reports: list[tuple[float, int]] = []
    predicted = 0
    now = 0.0
    while now < seconds:
        while arrivals and arrivals[0][0] <= now:
            clock.heard(arrivals[0][1], arrivals.pop(0)[0])
        while reports and reports[0][0] <= now:
            clock.reported(reports.pop(0)[1])
        while predicted < int(clock.target(now)):
            next_at_server = int((now + up) * RATE) + 1
            early.append(predicted - next_at_server)
            reports.append((now + up + delays(0), early[-1]))
            predicted += 1
        now += 0.002
    return clock, early


@pytest.mark.parametrize("one_way", [0.0, 0.02, 0.075, 0.15])
def test_inputs_come_in_time_whatever_the_delay(one_way):
    _, early = simulate(lambda _: one_way, up=one_way)
    settled = early[len(early) // 2 :]
    assert min(settled) >= 0
    assert max(settled) <= 6, "and not much earlier than needed"


def test_a_delay_that_grows_is_followed():
    _, early = simulate(lambda n: 0.01 if n < 400 else 0.06, up=0.05)
    assert min(early[len(early) * 3 // 4 :]) >= 0


@given(st.lists(st.floats(0.0, 0.05), min_size=50, max_size=50))
def test_it_never_runs_backwards_nor_much_faster_or_slower_than_the_server(jitter):
    clock = Clock(rate=RATE, tick=0, now=0.0, round_trip=0.03)
    last = clock.target(0.0)
    arrivals = sorted((n / RATE + 0.02 + jitter[n % 50], n + 1) for n in range(300))
    now = 1.0
    while arrivals and arrivals[0][0] <= now:
        clock.heard(arrivals[0][1], arrivals.pop(0)[0])
    last = clock.target(now)
    while now < 4.5:
        now += 0.01
        while arrivals and arrivals[0][0] <= now:
            clock.heard(arrivals[0][1], arrivals.pop(0)[0])
        target = clock.target(now)
        assert target >= last
        # Its own slip, and at most one better arrival than any before.
        assert target - last <= 0.01 * RATE * (1 + 2 * SLIP) + 0.05 * RATE
        last = target


def test_without_news_it_does_not_run_away():
    clock = Clock(rate=RATE, tick=0, now=0.0, round_trip=0.0)
    for n in range(60):
        clock.heard(n + 1, n / RATE)
    soon, late = clock.target(5.0), clock.target(500.0)
    assert late == pytest.approx(soon, abs=3.0)


def test_a_long_stall_of_the_server_is_jumped_over():
    clock = Clock(rate=RATE, tick=0, now=0.0, round_trip=0.0)
    for n in range(60):
        clock.heard(n + 1, n / RATE)
    clock.heard(61, 11.0)
    assert clock.snaps == 1
    for n in range(61, 200):
        clock.heard(n + 1, 11.0 + (n - 60) / RATE)
    now = 11.0 + 139 / RATE
    assert clock.target(now) == pytest.approx(200 + clock.lead, abs=1.0)


def test_a_stream_that_falls_back_for_good_is_followed():
    """A server that lost a moment is behind for good; a client that stayed ahead would predict too much."""
    clock = Clock(rate=RATE, tick=0, now=0.0, round_trip=0.0)
    arrival = 0.0
    for n in range(1500):
        arrival = n / RATE + (0.2 if n >= 100 else 0.0)
        clock.heard(n + 1, arrival)
        clock.target(arrival)
        if n == 100:
            assert clock.target(arrival) - (n + 1) > clock.lead + 10
    assert clock.target(arrival) - 1500 == pytest.approx(clock.lead, abs=0.5)
    assert clock.snaps == 0
