"""What is told again: all that somebody may have missed, as far as bytes allow."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from kuglice.inputs import Thrust, pack
from kuglice.protocol import MAX_TOLD_TICKS, StretchedTick, Tick, encode
from kuglice_server.repeats import BITS_PER_SECOND, DATAGRAM_BYTES, TOLD_ANYWAY, UNKNOWN, Repeats

RATE = 60
REST = 17


class Stream:
    """Ticks with so many inputs each, published as a server would."""

    def __init__(self) -> None:
        self.repeats = Repeats(RATE)
        self.ticks: list[StretchedTick] = []
        self.sizes: list[int] = []

    def tick(self, inputs: int, heard: list[int] | None = None) -> int:
        number = len(self.ticks)
        given = [Thrust(client=1 + n, sequence=number, x=0.5, y=0.25) for n in range(inputs)]
        self.ticks.append(StretchedTick(number, pack(given), number))
        recent = self.ticks[-MAX_TOLD_TICKS:]
        count = self.repeats.choose(recent, heard or [], rest=REST)
        self.sizes.append(len(encode(Tick.of(2**34, recent[-count:]))))
        self.repeats.spent(self.sizes[-1])
        return count

    @property
    def bits_per_second(self) -> float:
        return 8 * RATE * sum(self.sizes) / len(self.sizes)


def test_without_inputs_everything_that_may_be_missing_is_told_and_costs_nothing():
    stream = Stream()
    for number in range(200):
        told = stream.tick(0, [number - 30, number - 2])
    assert told == 31
    assert stream.bits_per_second < BITS_PER_SECOND


def test_who_is_behind_by_more_than_a_message_holds_does_not_count():
    stream = Stream()
    for number in range(200):
        told = stream.tick(0, [0, number - 9])
    assert told == 10


def test_where_nobody_says_what_was_heard_a_few_are_told():
    stream = Stream()
    assert [stream.tick(0) for _ in range(100)][-1] == UNKNOWN


def test_an_input_now_and_then_is_told_until_it_is_heard_within_the_budget():
    stream = Stream()
    told = [stream.tick(number % 12 == 0, [number - 20]) for number in range(1200)]
    assert stream.bits_per_second < BITS_PER_SECOND
    assert sum(told[60:]) / len(told[60:]) > 10


def test_a_session_of_seconds_after_a_long_quiet_stays_well_below_twenty_kilobits_too():
    stream = Stream()
    for number in range(600):
        stream.tick(0, [number - 20])
    quiet = len(stream.sizes)
    for number in range(quiet, quiet + 6 * RATE):
        stream.tick(number % 6 == 0, [number - 30])
    assert 8 * sum(stream.sizes[quiet:]) / 6 < 19_000


def test_what_a_burst_cost_beyond_the_budget_is_paid_back():
    stream = Stream()
    for number in range(10 * RATE):
        stream.tick(5 * (number % RATE < RATE // 4), [number - 30])
    assert stream.bits_per_second < BITS_PER_SECOND


def test_many_inputs_are_told_twice_whatever_that_costs():
    stream = Stream()
    told = [stream.tick(4, [number - 20]) for number in range(300)]
    assert set(told[60:]) == {TOLD_ANYWAY}


@given(st.lists(st.integers(0, 200), min_size=1, max_size=30), st.integers(0, 70))
def test_what_is_repeated_fits_into_a_datagram(inputs, behind):
    stream = Stream()
    for number, count in enumerate(inputs):
        told = stream.tick(count, [max(0, number - behind)])
        assert 1 <= told <= number + 1
        assert told == 1 or stream.sizes[-1] <= DATAGRAM_BYTES
