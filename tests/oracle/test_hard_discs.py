"""The oracle against what is known without it: closed forms, conservation laws, the way back."""

from __future__ import annotations

from itertools import pairwise

import gmpy2  # type: ignore[import-untyped]
import numpy as np
import pytest
from gmpy2 import mpfr

from oracle.hard_discs import EndlessHitsError, Oracle
from oracle.layout import gas

BOX = (0.0, 0.0, 10.0, 10.0)
BITS = 256
TINY = 1e-70


def furthest(one, two):
    with gmpy2.context(precision=BITS):
        return max((abs(a - b) for a, b in zip(np.ravel(one), np.ravel(two), strict=True)), default=mpfr(0))


@pytest.mark.parametrize(("m1", "m2"), [(1.0, 1.0), (1.0, 3.0), (1.0, 1e8)])
@pytest.mark.parametrize("restitution", [1.0, 0.5, 0.01])
def test_head_on_pair_leaves_as_the_two_conservation_laws_say(m1, m2, restitution):
    # Gap 4 - 1 - 0.5 - 0.5 = 2, approach 4: they meet after half a unit of time.
    oracle = Oracle(
        None, [(1, 0), (4, 0)], [(3, 0), (-1, 0)], [0.5, 0.5], [m1, m2], restitution=restitution, bits=BITS
    )
    oracle.run_to(0.5 - 2**-40)
    assert oracle.collisions == 0
    oracle.run_to(0.5 + 2**-40)
    assert oracle.collisions == 1
    with gmpy2.context(precision=BITS):
        m1, m2 = mpfr(m1), mpfr(m2)
        mean = (m1 * 3 - m2) / (m1 + m2)
        expected = [
            (mean - restitution * 4 * m2 / (m1 + m2), 0),
            (mean + restitution * 4 * m1 / (m1 + m2), 0),
        ]
    assert furthest(oracle.velocity, expected) < TINY


def test_oblique_pair_exchanges_along_the_line_of_centres_only():
    # At contact the line of centres is (3, 4) / 5: ball 0 comes along x and gives away just that part of
    # its speed.
    oracle = Oracle(None, [(-7, -4), (3 - 7 + 7, 0)], [(1, 0), (0, 0)], [2.5, 2.5], [1, 1], bits=BITS)
    oracle.run_to(7)
    assert oracle.collisions == 1
    with gmpy2.context(precision=BITS):
        n = (mpfr(3) / 5, mpfr(4) / 5)
        given = [n[0] * n[0], n[0] * n[1]]
        assert furthest(oracle.velocity, [(1 - given[0], -given[1]), given]) < TINY


def test_cradle_passes_the_motion_on_to_its_last_ball():
    x = [0.0, 3.0, 4.25, 5.5, 6.75]
    oracle = Oracle(None, [(a, 0) for a in x], [(2, 0)] + [(0, 0)] * 4, [0.5] * 5, [1] * 5, bits=BITS)
    oracle.run_to(4)
    assert oracle.collisions == 4
    assert furthest(oracle.velocity, [(0, 0)] * 4 + [(2, 0)]) < TINY
    # Each ball stops where it touches the next; the last has flown what is left of the time.
    gaps = 2.0 + 3 * 0.25
    assert furthest(oracle.position[:, 0], [2.0, 3.25, 4.5, 5.75, 6.75 + 8 - gaps]) < TINY


@pytest.mark.parametrize("restitution", [1.0, 0.75])
def test_bouncing_ball_reaches_the_height_and_time_of_the_closed_form(restitution):
    # Dropped from height 5 under g = 10: floor after 1, then hops of 2 e^k, rising to 5 e^(2k).
    oracle = Oracle(BOX, [(5, 6)], [(0, 0)], [1], [1], gravity=(0, -10), restitution=restitution, bits=BITS)
    landing = 1.0
    for hop in range(1, 9):
        top = landing + restitution**hop
        oracle.run_to(top)
        assert oracle.wall_hits == hop
        with gmpy2.context(precision=BITS):
            assert furthest(oracle.position[0], (5, 1 + 5 * mpfr(restitution) ** (2 * hop))) < 1e-60
        landing += 2 * restitution**hop


def test_walls_send_a_ball_round_a_billiard_table():
    # Unfolded, a ball among four walls flies straight: fold its path back into the box.
    oracle = Oracle(BOX, [(2, 3)], [(1.25, -0.75)], [1], [1], bits=BITS)
    for time in range(0, 200, 7):
        oracle.run_to(time)
        for place, start, speed in zip(oracle.position[0], (2, 3), (1.25, -0.75), strict=True):
            folded = (start - 1 + speed * time) % 16
            assert abs(place - 1 - min(folded, 16 - folded)) < TINY


@pytest.mark.parametrize(("follower", "collisions", "wall_hits", "velocity"), [
    # Ball 0 flies left from x = 3 and turns at the wall (x = 1) after 2; ball 1 chases it, twice as fast.
    (5.5, 1, 0, (-2, -1)),  # catches it after 0.5, well before the wall: they change places
    (9.0, 1, 1, (-2, 1)),  # would catch it after 4: meets it on its way back from the wall after 2 + 2/3
])  # fmt: skip
def test_wall_and_pair_happen_in_the_order_of_time(follower, collisions, wall_hits, velocity):
    oracle = Oracle((0, 0, 20, 4), [(3, 2), (follower, 2)], [(-1, 0), (-2, 0)], [1, 1], [1, 1], bits=BITS)
    oracle.run_to(1 if wall_hits == 0 else 2.75)
    assert (oracle.collisions, oracle.wall_hits) == (collisions, wall_hits)
    assert furthest(oracle.velocity[:, 0], velocity) < TINY


def test_peg_does_not_move_and_turns_a_ball_back():
    oracle = Oracle(BOX, [(5, 2), (5, 8)], [(0, 0), (0, 0)], [1, 1], [np.inf, 1], gravity=(0, -8), bits=BITS)
    # It falls 4 in a time of 1, then bounces between the peg's top and where it started.
    for time, height in ((0.5, 7), (1.5, 7), (2, 8), (2.5, 7), (4, 8)):
        oracle.run_to(time)
        assert furthest(oracle.position, [(5, 2), (5, height)]) < TINY
    assert oracle.collisions == 2


def test_closed_gas_keeps_its_energy_to_the_last_digits():
    oracle = gas(1, 12, 0.3, unequal=True, pegs=2, gravity=(0.5, -1.0)).oracle(BITS)
    before = oracle.energy
    oracle.run_to(10)
    assert oracle.collisions > 50
    assert abs(oracle.energy / before - 1) < 1e-65


def test_collisions_keep_momentum_and_inelastic_ones_lose_energy():
    start = gas(2, 12, 0.5, unequal=True, restitution=0.8)
    inward = (start.box[2] / 2 - start.position) + start.velocity
    oracle = Oracle(None, start.position, inward, start.radius, start.mass, restitution=0.8, bits=BITS)
    momentum, energy = oracle.momentum, oracle.energy
    oracle.run_to(3)
    assert oracle.collisions >= 12
    assert furthest(oracle.momentum, momentum) < TINY
    assert oracle.energy < 0.95 * energy


def way_back(bits, time):
    """How far from its start a gas ends that runs for `time`, is turned round, and runs for `time` again."""
    start = gas(3, 16, 0.3, unequal=True, gravity=(0.0, -0.5))
    there = start.oracle(bits)
    there.run_to(time)
    assert there.collisions > 300
    with gmpy2.context(precision=bits):  # even a minus sign rounds to the precision of the context
        turned = -there.velocity
    back = Oracle(
        start.box, there.position, turned, start.radius, start.mass, gravity=start.gravity, bits=bits
    )
    back.run_to(time)
    return furthest(back.position, start.position)


def test_turned_round_it_runs_back_to_its_start_if_the_bits_suffice():
    # 40 collisions per disc, each way, are far beyond what 53 bits can follow.
    assert way_back(256, 20) < 1e-30
    assert way_back(53, 20) > 0.1


def test_more_bits_say_the_same_with_more_digits():
    runs = [gas(4, 16, 0.3, pegs=2, gravity=(0.0, -1.0)).oracle(bits) for bits in (96, 160, 224)]
    for run in runs:
        run.run_to(4)
    coarse, fine = (furthest(one.position, two.position) for one, two in pairwise(runs))
    assert coarse < 1e-20
    assert fine < 1e-39
    assert runs[0].collisions == runs[1].collisions == runs[2].collisions > 16


def test_predictions_kept_from_before_are_those_made_anew():
    # Only balls that were hit, or lost their partner, look again; everyone looking again is the judge.
    kept, anew = (gas(5, 16, 0.5, unequal=True).oracle(BITS) for _ in range(2))
    for time in np.arange(0.0, 2.0, 2**-6):
        kept.run_to(time)
        anew.look_again()
        anew.run_to(time)
    assert kept.collisions == anew.collisions > 80
    assert furthest(kept.position, anew.position) < 1e-60


def test_collapse_is_an_error_and_no_endless_loop():
    oracle = Oracle(
        BOX, [(5, 2)], [(0, 0)], [1], [1], gravity=(0, -10), restitution=0.5, bits=64, most_hits=500
    )
    with pytest.raises(EndlessHitsError, match="500 hits: ball 0 and bottom"):
        oracle.run_to(10)


def test_states_that_are_none_are_refused():
    with pytest.raises(ValueError, match="infinite mass"):
        Oracle(BOX, [(5, 5)], [(1, 0)], [1], [np.inf])
    oracle = Oracle(BOX, [(5, 5)], [(1, 0)], [1], [1])
    oracle.run_to(1)
    with pytest.raises(ValueError, match="before"):
        oracle.run_to(0.5)
