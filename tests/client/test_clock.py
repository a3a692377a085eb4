"""The clock of a client: how it follows what it hears, on its own and in a simulated game over bad links."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from client.simulated_link import RATE, TURN_SECONDS, Played, Simulation
from kuglice.lab.network.conditions import Conditions
from kuglice_client.clock import (
    FALL_SECONDS,
    FIRST_JITTER_TRIPS,
    REPEAT_TICKS,
    REPORTS,
    RETRANSMISSION_TRIPS,
    SAFETY_TICKS,
    SETTLING_SECONDS,
    SLEW,
    STALL_SECONDS,
    Clock,
)

ROUND_TRIPS = (0.0, 0.05, 0.15, 0.3)
SECONDS = 30.0


def clock(round_trip: float = 0.0) -> Clock:
    return Clock(rate=RATE, tick=0, now=0.0, round_trip=round_trip)


def paces_after(played: Played, since: float) -> list[float]:
    """Ticks per tick of the server, from turn to turn."""
    pairs = itertools.pairwise(turn for turn in played.turns if turn[0] > since)
    return [(late[1] - soon[1]) / (TURN_SECONDS * RATE) for soon, late in pairs]


@pytest.mark.parametrize("round_trip", ROUND_TRIPS)
@pytest.mark.parametrize("jitter", [0.0, 0.2])
@pytest.mark.parametrize("loss", [0.0, 0.02])
def test_fewer_than_5_in_1000_inputs_are_late_as_datagrams(round_trip, jitter, loss):
    early = []
    for seed in (1, 2):
        link = Conditions(round_trip=round_trip, jitter=jitter, loss=loss, seed=seed)
        played = Simulation(link).run(SECONDS)
        early += played.early
        paces = paces_after(played, played.turns[0][0] + SETTLING_SECONDS)
        assert max(paces) <= 1 + SLEW + 1e-6
        assert min(paces) >= 1 - SLEW - 1e-6
        # What it takes: the way there and back, the spread of the way there, a copy if the first is lost.
        needed = RATE * round_trip * (1 + jitter) + (REPEAT_TICKS + 1 if loss else 0)
        assert played.clock.lead <= needed + 2
    assert 1000 * sum(one < 0 for one in early) / len(early) < 5


@pytest.mark.parametrize("round_trip", ROUND_TRIPS)
@pytest.mark.parametrize("loss", [0.0, 0.02])
def test_fewer_than_5_in_1000_are_late_in_a_stream_that_waits_for_what_was_lost(round_trip, loss):
    early = []
    for seed in (1, 2, 3):
        link = Conditions(round_trip=round_trip, jitter=0.2, loss=loss, seed=seed)
        played = Simulation(link, stream=True).run(SECONDS)
        early += played.early
    assert 1000 * sum(one < 0 for one in early) / len(early) < 5


@pytest.mark.parametrize("seed", range(8))
def test_the_first_inputs_are_in_time_too_whatever_the_round_trip_that_was_measured_first(seed):
    """It was one of the shortest that there are, say, and the stream has had no time to vary."""
    link = Conditions(round_trip=0.15, jitter=0.2, seed=seed)
    played = Simulation(link, first_trip=0.15 * (1 - 0.2)).run(2.0)
    assert sum(one < 0 for one in played.early) == 0


def test_who_acts_seldom_is_in_time_too():
    link = Conditions(round_trip=0.15, jitter=0.2, loss=0.02)
    played = Simulation(link, every=60.0).run(4 * SECONDS)
    assert len(played.early) < REPORTS
    assert sum(one < 0 for one in played.early) <= 1


def test_an_input_delay_takes_the_place_of_lead():
    link = Conditions(round_trip=0.05, jitter=0.2, loss=0.02)
    at_once, delayed = (Simulation(link, input_delay=delay).run(SECONDS) for delay in (0, 3))
    assert at_once.clock.lead - delayed.clock.lead == pytest.approx(3, abs=1)
    assert delayed.late_per_1000 < 5


def test_a_lead_too_long_is_given_up_at_2_percent():
    settled = round(SETTLING_SECONDS * RATE) + 1
    one = clock(round_trip=0.3)
    for n in range(600):
        one.heard(n + 1, n / RATE)
        one.target(n / RATE)
        if n >= settled:
            one.answered(0.0)
    slewed = (600 - settled) * SLEW
    assert one.lead == pytest.approx((1 + FIRST_JITTER_TRIPS) * 0.3 * RATE + 1.5 - slewed, abs=0.5)
    assert one.pace == pytest.approx(1 - SLEW)


@pytest.mark.parametrize("stream", [False, True])
@pytest.mark.parametrize("round_trip", [0.15, 0.3])
def test_a_lead_too_long_from_the_start_is_given_up_soon(round_trip, stream):
    """A segment was lost when it was asked for the first time; half a minute went by with half a second of lead."""
    link = Conditions(round_trip=round_trip, jitter=0.2, seed=3)
    first_trip = round_trip + 0.3
    right, held_up = (
        Simulation(link, stream=stream, first_trip=trip).run(first_trip + 1.5)
        for trip in (round_trip, first_trip)
    )
    assert held_up.clock.lead == pytest.approx(right.clock.lead, abs=FALL_SECONDS * RATE)
    ticks = [tick for _, tick in held_up.turns]
    assert ticks == sorted(ticks), "what was shown is not taken back"
    assert min(held_up.early) >= 0
    assert held_up.clock.snaps == 0


@pytest.mark.parametrize("stream", [False, True])
def test_what_queues_behind_a_state_at_the_start_is_not_taken_for_jitter(stream):
    """Until the state that was asked for is here and for a while after, ticks are late that never will be again."""
    link = Conditions(round_trip=0.15, jitter=0.2, seed=3)
    free, queued = (
        Simulation(link, stream=stream, queue=lambda now, most=most: max(0.0, most - 0.5 * now)).run(4.0)
        for most in (0.0, 0.5)
    )
    assert queued.clock.lead == pytest.approx(free.clock.lead, abs=3.0)
    assert queued.clock.jitter == pytest.approx(free.clock.jitter, abs=0.02)


def test_the_worst_report_counts_from_the_lead_that_its_input_was_made_with():
    one = clock()
    for n in range(REPORTS):
        one.heard(n + 1, n / RATE)
        # All of them ask for 8 ticks, however early they came; one asks for 9.
        one.reported(n % 5, lead=8.0 + n % 5 + (n == 100), made=n / RATE)
    assert one.wanted_lead == 9.0 + SAFETY_TICKS
    for n in range(REPORTS, 2 * REPORTS):
        one.heard(n + 1, n / RATE)
        one.reported(2, lead=10.0, made=n / RATE)
    assert one.wanted_lead == 8.0 + SAFETY_TICKS, "what is long past is forgotten"


def test_what_a_cut_held_up_asks_for_no_lead():
    one = clock()
    for n in range(60):
        one.heard(n + 1, n / RATE)
        one.target(n / RATE)
    wanted = one.wanted_lead
    one.heard(361, 6.0)
    one.target(6.0)
    one.reported(-20, lead=2.0, made=5.6)
    one.reported(-200, lead=2.0, made=2.0)
    assert one.wanted_lead == pytest.approx(wanted, abs=0.1)
    assert one.target(6.0) == pytest.approx(361 + wanted, abs=0.5), "and it is where the server is at once"


@given(st.lists(st.floats(0.0, 0.05), min_size=50, max_size=50))
def test_however_messages_come_it_never_runs_backwards_nor_much_faster_or_slower_than_the_server(jitter):
    one = clock(round_trip=0.03)
    arrivals = sorted((n / RATE + 0.02 + jitter[n % 50], n + 1) for n in range(300))
    now, last = 0.0, None
    while now < 5.0:
        now += 0.01
        while arrivals and arrivals[0][0] <= now:
            one.heard(arrivals[0][1], arrivals.pop(0)[0])
        target = one.target(now)
        if last is not None and now > SETTLING_SECONDS + 0.05:
            assert (1 - SLEW) * 0.01 * RATE - 1e-6 <= target - last <= (1 + SLEW) * 0.01 * RATE + 1e-6
        assert last is None or target >= last
        last = target


@given(st.lists(st.tuples(st.integers(-30, 30), st.floats(0.0, 60.0)), max_size=20))
def test_whatever_is_reported_it_gets_there_at_2_percent_and_never_jumps(reports):
    one = clock(round_trip=0.03)
    last = None
    for n in range(300):
        now = n / RATE
        one.heard(n + 1, now)
        if reports and n >= SETTLING_SECONDS * RATE:
            early, lead = reports[n % len(reports)]
            one.reported(early, lead=lead, made=now)
        target = one.target(now)
        if last is not None and now > SETTLING_SECONDS:
            assert 1 - SLEW - 1e-6 <= target - last <= 1 + SLEW + 1e-6
        last = target
    assert one.snaps == 0


def test_what_was_needed_on_a_link_that_is_gone_is_forgotten():
    """Over tcp alone one lost segment asks for a round trip more; 256 reports long datagrams would have paid for it."""
    one = clock(round_trip=0.3)
    for n in range(400):
        one.heard(n + 1, n / RATE)
        one.target(n / RATE)
        one.reported(-12 if n == 300 else 12, lead=40.0, made=n / RATE)
    assert one.wanted_lead == 52.0 + SAFETY_TICKS
    one.relinked(400 / RATE, in_order=False)
    one.reported(-12, lead=40.0, made=399 / RATE)
    one.heard(401, 400 / RATE)
    assert one.wanted_lead == pytest.approx(SAFETY_TICKS + REPEAT_TICKS + 0.3 * RATE, abs=0.1)


def test_without_news_it_does_not_run_away():
    one = clock()
    for n in range(60):
        one.heard(n + 1, n / RATE)
        one.target(n / RATE)
    soon, late = one.target(5.0), one.target(500.0)
    assert soon == late <= 60 + one.wanted_lead + STALL_SECONDS * RATE


def test_a_long_stall_of_the_server_is_jumped_over():
    one = clock()
    for n in range(60):
        one.heard(n + 1, n / RATE)
        one.target(n / RATE)
    for n in range(60, 200):
        one.heard(n + 1, 11.0 + (n - 60) / RATE)
        one.target(11.0 + (n - 60) / RATE)
    assert one.snaps == 1
    assert one.target(11.0 + 139 / RATE) == pytest.approx(200 + one.wanted_lead, abs=1.0)


def test_a_stream_that_falls_back_for_good_is_followed():
    """A server that lost a moment is behind for good; a client that stayed ahead would predict too much."""
    link = Conditions(round_trip=0.02)
    played = Simulation(link, server_lag=lambda n: 0.2 if n >= 300 else 0.0).run(SECONDS)
    assert played.clock.snaps == 0
    assert played.clock.lead == pytest.approx(0.02 * RATE + 1.5, abs=1.5)
    assert played.late_per_1000 < 5


def falls_back(ticks_per_second: float):
    """How late each tick is of a server that makes so many per second."""
    return lambda tick: tick * (1 / ticks_per_second - 1 / RATE)


@pytest.mark.parametrize("made", [59.0, 57.0, 50.0, 30.0])
@pytest.mark.parametrize("round_trip", [0.0, 0.15])
@pytest.mark.parametrize("stream", [False, True], ids=["datagrams", "stream"])
def test_a_server_that_is_too_slow_all_the_time_is_followed_at_its_own_rate(made, round_trip, stream):
    """Regression: at 57 ticks per second the lead grew without end, until every input came too early to be taken."""
    bad = round_trip > 0
    link = Conditions(round_trip=round_trip, jitter=0.2 * bad, loss=0.02 * bad)
    played = Simulation(link, stream=stream, server_lag=falls_back(made)).run(2 * SECONDS)
    last = played.leads[len(played.leads) // 2 :]
    assert max(last) < RATE * 2 * (1 + RETRANSMISSION_TRIPS * stream) * round_trip + 3
    assert max(played.early) < RATE, "a second is too early by much"
    assert played.late_per_1000 < 5


def test_a_server_that_keeps_its_rate_again_is_met_again():
    made, slow = 50.0, 600
    lag = falls_back(made)
    link = Conditions(round_trip=0.15, jitter=0.2, loss=0.02)
    played = Simulation(link, server_lag=lambda tick: lag(min(tick, slow))).run(2 * SECONDS)
    assert played.clock.snaps == 0
    assert played.clock.lead == pytest.approx(RATE * 0.15 * 1.2 + REPEAT_TICKS + 1, abs=2)
    assert played.late_per_1000 < 5
