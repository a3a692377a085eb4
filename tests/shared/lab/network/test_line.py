"""When packets arrive: one direction of a conditioned link, without any network."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import NetworkError
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.line import Line

BAD = Conditions(round_trip=0.15, jitter=0.2, loss=0.02, seed=7)


def arrivals(line: Line, count: int, *, every: float = 1 / 60, size: int = 100) -> list[tuple[float, ...]]:
    return [line.packet(number * every, size) for number in range(count)]


def test_a_perfect_link_takes_no_time_and_loses_nothing():
    assert arrivals(Line(Conditions(), 0), 100) == [(number * (1 / 60),) for number in range(100)]


def test_delay_is_half_the_round_trip_give_or_take_the_jitter():
    delays = [
        times[0] - number * (1 / 60)
        for number, times in enumerate(arrivals(Line(Conditions(round_trip=0.15, jitter=0.2), 0), 5000))
    ]
    assert min(delays) >= 0.060 - 1e-9
    assert max(delays) <= 0.090 + 1e-9
    assert sum(delays) / len(delays) == pytest.approx(0.075, abs=0.004)


def test_a_share_of_the_packets_is_lost():
    lost = arrivals(Line(BAD, 0), 20_000).count(())
    assert lost == pytest.approx(400, abs=80)


def test_equal_seeds_are_equal_fates_and_directions_differ():
    assert arrivals(Line(BAD, 0), 500) == arrivals(Line(BAD, 0), 500)
    assert arrivals(Line(BAD, 0), 500) != arrivals(Line(BAD, 1), 500)


def test_the_fate_of_a_packet_depends_on_its_number_alone():
    """What is cut off, doubled or large does not shift the luck of those that follow."""
    undisturbed = arrivals(Line(BAD, 0), 200)
    line = Line(BAD, 0)
    line.cut(until=0.5)
    disturbed = [line.packet(number * (1 / 60), 5 * number) for number in range(200)]
    assert disturbed[:30] == [()] * 30
    assert disturbed[40:] == undisturbed[40:]


def test_a_flow_keeps_its_order_unless_told_otherwise():
    spread = Conditions(round_trip=0.2, jitter=1.0)
    times = [each[0] for each in arrivals(Line(spread, 0), 1000, every=0.001)]
    assert times == sorted(set(times))
    overtaking = Conditions(round_trip=0.2, jitter=1.0, reorder=True)
    times = [each[0] for each in arrivals(Line(overtaking, 0), 1000, every=0.001)]
    assert times != sorted(times)


def test_one_flow_does_not_hold_another_back():
    line = Line(Conditions(round_trip=2.0, jitter=1.0, seed=3), 0)
    for number in range(100):
        line.packet(0.001 * number, 100, "a")
    fresh = [line.packet(0.1, 100, flow)[0] for flow in range(200)]
    assert min(fresh) < 0.3


def test_duplicates_come_after_the_original():
    for times in arrivals(Line(Conditions(round_trip=0.1, duplicate=1.0), 0), 50):
        first, second = times
        assert first < second


def test_a_narrow_link_makes_packets_queue():
    line = Line(Conditions(bandwidth=1000.0), 0)
    assert [line.packet(0.0, 100)[0] for _ in range(3)] == pytest.approx([0.1, 0.2, 0.3])
    assert line.packet(10.0, 100)[0] == pytest.approx(10.1)


def test_a_cut_loses_and_a_stall_holds():
    line = Line(Conditions(round_trip=0.1), 0)
    line.cut(until=1.0)
    assert line.packet(0.9, 100) == ()
    assert line.packet(1.0, 100) == (1.05,)
    line.stall(until=3.0)
    assert line.packet(2.0, 100) == (3.05,)
    assert line.packet(3.5, 100) == (3.55,)


ORDERS = st.lists(
    st.tuples(st.sampled_from(["cut", "stall"]), st.integers(0, 30), st.integers(0, 30)), max_size=8
).map(lambda orders: sorted(orders, key=lambda order: order[1]))
"""Each with the second at which it comes, and the seconds that it lasts."""


@given(ORDERS, st.integers(0, 60))
def test_interruptions_that_overlap_last_until_the_last_of_them_is_over(orders, now):
    line = Line(Conditions(), 0)
    for kind, at, seconds in orders:
        if at <= now:
            getattr(line, kind)(until=float(at + seconds))
    ends = {
        kind: max((at + seconds for each, at, seconds in orders if each == kind and at <= now), default=0)
        for kind in ("cut", "stall")
    }
    expected = () if now < ends["cut"] else (float(max(now, ends["stall"])),)
    assert line.packet(float(now), 100) == expected


def test_a_line_that_is_mended_is_cut_no_longer():
    line = Line(Conditions(), 0)
    line.cut(until=9.0)
    line.mend()
    assert line.packet(1.0, 100) == (1.0,)


def test_a_stream_loses_nothing_but_waits_for_the_retransmission():
    line = Line(Conditions(round_trip=0.1, loss=0.1, seed=2), 0)
    times = [line.stream(number / 60, 100) for number in range(1000)]
    assert times == sorted(set(times))
    delays = [time - number / 60 for number, time in enumerate(times)]
    assert min(delays) == pytest.approx(0.05)
    assert max(delays) > 0.19


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"round_trip": -1.0}, "round trip -1000 ms: must be 0 to 60000 ms"),
        ({"round_trip": float("nan")}, "round trip nan"),
        ({"loss": 1.5}, "loss 1.5: must be 0 to 1"),
        ({"bandwidth": float("nan")}, "bandwidth nan"),
    ],
)
def test_conditions_that_cannot_be_are_refused(wrong, words):
    with pytest.raises(NetworkError, match=words):
        Conditions(**wrong)


def test_conditions_travel_as_messages():
    assert Conditions.from_message(BAD.to_message()) == BAD
    with pytest.raises(NetworkError, match="conditions"):
        Conditions.from_message({"lag": 3})
