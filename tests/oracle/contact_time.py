"""When does it touch? The three questions of the oracle, each answered as in a schoolbook.

Every function takes the state now and returns how long from now until the next contact, or None if there is
none. A contact is a fall: a distance that reaches zero while it shrinks. What rounding has left already
inside and still going inwards is in contact now; what is inside and going outwards is left alone (Bannerman
et al., arXiv 1211.6718). Numbers are gmpy2 mpfr; every operation rounds to the precision of the caller's
gmpy2 context.
"""

from __future__ import annotations

from itertools import pairwise

import gmpy2  # type: ignore[import-untyped]
from gmpy2 import mpfr, sqrt


def time_to_wall(gap: mpfr, speed: mpfr, acceleration: mpfr) -> mpfr | None:
    """Until gap + speed t + acceleration t^2 / 2 falls to zero: the falling root of a quadratic.

    `gap` is what lies between ball and wall; speed and acceleration are counted away from the wall.
    """
    if speed < 0:
        if gap <= 0:
            return mpfr(0)
        square = speed * speed - 2 * acceleration * gap
        # The other form of the root, (-speed - root) / acceleration, has no digits left when gravity is weak.
        return None if square < 0 else 2 * gap / (sqrt(square) - speed)
    if acceleration >= 0:
        return None
    square = speed * speed - 2 * acceleration * gap
    # A negative square: so deep by rounding that its hop does not clear the wall. It hits at the top.
    return (speed + sqrt(max(square, mpfr(0)))) / -acceleration


def time_to_pair(dx: mpfr, dy: mpfr, dvx: mpfr, dvy: mpfr, reach: mpfr) -> mpfr | None:
    """Until |d + dv t| falls to reach: relative motion along a straight line."""
    approach = dx * dvx + dy * dvy
    if approach >= 0:
        return None
    outside = dx * dx + dy * dy - reach * reach
    if outside <= 0:
        return mpfr(0)
    square = approach * approach - (dvx * dvx + dvy * dvy) * outside
    return None if square < 0 else outside / (sqrt(square) - approach)


def time_to_pair_on_parabola(
    d: tuple[mpfr, mpfr], dv: tuple[mpfr, mpfr], da: tuple[mpfr, mpfr], reach: mpfr
) -> mpfr | None:
    """Until |d + dv t + da t^2 / 2| falls to reach: a falling ball and a fixed one.

    f = |...|^2 - reach^2 is a quartic, monotonous between the zeros of f', which is monotonous between the
    zeros of f''. So no formula for a quartic is needed: bisection between turning points finds every zero.
    """
    if da[0] == 0 and da[1] == 0:
        return time_to_pair(*d, *dv, reach)
    dot = [u[0] * v[0] + u[1] * v[1] for u, v in ((d, d), (d, dv), (dv, dv), (d, da), (dv, da), (da, da))]
    f = [dot[0] - reach * reach, 2 * dot[1], dot[2] + dot[3], dot[4], dot[5] / 4]
    if f[0] <= 0 and f[1] < 0:
        return mpfr(0)
    slope = [k * f[k] for k in range(1, 5)]
    bend = [k * slope[k] for k in range(1, 4)]
    turns = zeros(slope, zeros(bend, zeros([bend[1], 2 * bend[2]], [])))
    # Signs alternate: from outside (f > 0) the first zero is a fall, from inside it is the second.
    falls = zeros(f, turns)[0 if f[0] > 0 else 1 :]
    return falls[0] if falls else None


def value(polynomial: list[mpfr], t: mpfr) -> mpfr:
    """Of c0 + c1 t + c2 t^2 + ..."""
    result = mpfr(0)
    for coefficient in reversed(polynomial):
        result = result * t + coefficient
    return result


def zeros(polynomial: list[mpfr], turns: list[mpfr]) -> list[mpfr]:
    """All t > 0 at which the polynomial changes sign, in order.

    Its highest coefficient is positive; `turns` are those of its derivative.
    """
    far = (turns[-1] if turns else mpfr(0)) + 1
    while value(polynomial, far) <= 0:
        far *= 2
    marks = [mpfr(0), *turns, far]
    found = []
    for low, high in pairwise(marks):
        rising = value(polynomial, high) > 0
        if (value(polynomial, low) > 0) != rising:
            found.append(bisect(polynomial, low, high, rising))
    return found


def bisect(polynomial: list[mpfr], low: mpfr, high: mpfr, rising: bool) -> mpfr:
    """The one sign change in between, to the last bit of the interval's longer end."""
    for _ in range(gmpy2.get_context().precision + 2):
        middle = (low + high) / 2
        if (value(polynomial, middle) > 0) == rising:
            high = middle
        else:
            low = middle
    return (low + high) / 2
