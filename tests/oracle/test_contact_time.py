"""The three contact times: at the time found they touch while closing in, and at no time before."""

from __future__ import annotations

import gmpy2  # type: ignore[import-untyped]
import pytest
from gmpy2 import mpfr
from hypothesis import assume, given
from hypothesis import strategies as st

from oracle.contact_time import time_to_pair, time_to_pair_on_parabola, time_to_wall

number = st.floats(-10, 10, allow_subnormal=False)
gap = st.floats(0.001, 10)
vector = st.tuples(number, number)


@st.composite
def aimed(draw, widest_miss):
    """(d, v, reach): closing in along a line that passes within `widest_miss` reaches of the centre."""
    reach, ahead, miss = (
        mpfr(draw(s)) for s in (st.floats(0.1, 2), gap, st.floats(-widest_miss, widest_miss))
    )
    velocity = draw(vector)
    assume(abs(velocity[0]) + abs(velocity[1]) > 0.01)
    v = [mpfr(a) for a in velocity]
    speed = gmpy2.sqrt(squared(v))
    back, side = (reach + ahead) / speed, miss * reach / speed
    return [-back * v[0] + side * v[1], -back * v[1] - side * v[0]], v, reach


@pytest.fixture(autouse=True)
def _plenty_of_bits():
    with gmpy2.context(precision=300):
        yield


def along(point, velocity, acceleration, t):
    return [p + v * t + a * t * t / 2 for p, v, a in zip(point, velocity, acceleration, strict=True)]


def squared(v):
    return v[0] * v[0] + v[1] * v[1]


@given(gap, number, number)
def test_wall_is_reached_falling_and_not_before(gap, speed, acceleration):
    t = time_to_wall(mpfr(gap), mpfr(speed), mpfr(acceleration))
    if t is None:
        # Then it flies away for ever, or turns back before it gets there.
        assert acceleration >= 0
        assert speed >= 0 or mpfr(speed) ** 2 < 2 * mpfr(acceleration) * mpfr(gap)
        return
    assume(t < 1e6)
    assert abs(gap + speed * t + acceleration * t * t / 2) < 1e-60
    assert speed + acceleration * t <= 1e-30
    assert all(gap + speed * s + acceleration * s * s / 2 > 0 for s in (t * k / 64 for k in range(64)))


@given(aimed(widest_miss=1.5))
def test_pair_touches_falling_and_not_before(state):
    d, v, reach = state
    t = time_to_pair(*d, *v, reach)
    if t is None:
        nearest = along(d, v, (0, 0), -(d[0] * v[0] + d[1] * v[1]) / squared(v))
        assert squared(nearest) >= reach**2 * (1 - mpfr(10) ** -60)
        return
    assert abs(squared(along(d, v, (0, 0), t)) - reach**2) < 1e-60
    assert all(squared(along(d, v, (0, 0), t * k / 64)) > reach**2 for k in range(64))


@given(vector, vector, vector, st.floats(0.1, 2))
def test_falling_ball_touches_peg_falling_and_not_before(apart, velocity, acceleration, reach):
    d, v, a = ([mpfr(x) for x in u] for u in (apart, velocity, acceleration))
    reach = mpfr(reach)
    assume(squared(d) > reach**2)
    assume(squared(a) == 0 or squared(a) > 1e-6)
    t = time_to_pair_on_parabola(tuple(d), tuple(v), tuple(a), reach)
    until = t if t is not None else mpfr(100)
    assert all(
        squared(along(d, v, a, until * k / 256)) > reach**2 * (1 - mpfr(10) ** -60) for k in range(256)
    )
    if t is not None and t < 1e3:
        assert abs(squared(along(d, v, a, t)) - reach**2) < 1e-60


@given(aimed(widest_miss=0.99))
def test_a_parabola_that_hardly_bends_is_a_straight_line(state):
    d, v, reach = state
    bent = time_to_pair_on_parabola(tuple(d), tuple(v), (mpfr(10) ** -60, mpfr(0)), reach)
    assert abs(bent - time_to_pair(*d, *v, reach)) < 1e-30


def test_a_parabola_may_pass_over_a_peg_and_hit_it_coming_down():
    # Thrown straight up from the top of the peg: it is back there after 2 v / g = 2.
    t = time_to_pair_on_parabola((mpfr(0), mpfr(2)), (mpfr(0), mpfr(10)), (mpfr(0), mpfr(-10)), mpfr(2))
    assert abs(t - 2) < 1e-60


def test_inside_and_closing_is_now_inside_and_parting_is_never():
    assert time_to_pair(mpfr(1), mpfr(0), mpfr(-1), mpfr(0), mpfr("1.5")) == 0
    assert time_to_pair(mpfr(1), mpfr(0), mpfr(1), mpfr(0), mpfr("1.5")) is None
    assert time_to_wall(mpfr(-1), mpfr(-1), mpfr(0)) == 0
    assert time_to_wall(mpfr(-1), mpfr(1), mpfr(0)) is None
