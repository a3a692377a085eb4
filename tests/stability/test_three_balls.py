"""Three balls in one tick: the order of collisions decides the outcome, and energy is kept whatever it is."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from stability.chain import Chain
from stability.worlds import make

RADIUS = [0.5, 0.5, 0.5]


def line(place, velocity, mass, contacts, radius=RADIUS):
    count = len(place)
    return make(
        np.stack([place, np.zeros(count)], axis=1),
        np.stack([velocity, np.zeros(count)], axis=1),
        radius=radius,
        mass=mass,
        tick_rate=1.0,
        contacts=contacts,
    )


@given(
    gaps=st.tuples(st.floats(0, 1), st.floats(0, 1)),
    speeds=st.tuples(st.floats(0.1, 10), st.floats(0.1, 10)),
    mass=st.tuples(*[st.floats(0.1, 10)] * 3),
)
def test_hit_from_both_sides_in_one_tick(gaps, speeds, mass):
    place = [-1 - gaps[0], 0.0, 1 + gaps[1]]
    velocity = [speeds[0], 0.0, -speeds[1]]
    chain = Chain.of(place, velocity, RADIUS, mass)
    chain.run(1.0)
    # A tie, or a hit at the end of the tick, is decided by rounding.
    assume(abs(gaps[0] / speeds[0] - gaps[1] / speeds[1]) > 1e-9)
    world = line(place, velocity, mass, "event")
    energy, momentum = world.energy, world.momentum
    world.step()
    assume(abs(chain.collisions - world.collisions) <= 1)
    if chain.collisions == world.collisions:
        assert world.position[:, 0] == pytest.approx([float(x) for x in chain.place], abs=1e-9)
        assert world.velocity[:, 0] == pytest.approx([float(v) for v in chain.velocity], abs=1e-9)
    assert world.energy == pytest.approx(energy, rel=1e-13)
    assert world.momentum[0] == pytest.approx(momentum[0], abs=1e-13 * sum(mass) * max(speeds))


def test_event_takes_hits_by_time_and_overlap_by_id():
    # The right ball is there first; at the end of the tick both pairs overlap.
    place, velocity, mass = [-1.4, 0.0, 1.1], [0.5, 0.0, -0.5], [1.0, 2.0, 3.0]
    first = Chain.of(place, velocity, RADIUS, mass)
    first.run(1.0)
    by_time = line(place, velocity, mass, "event")
    by_time.step()
    assert by_time.velocity[:, 0] == pytest.approx([float(v) for v in first.velocity], rel=1e-14)

    def exchanged(m, n, u, v):
        return (u * (m - n) + 2 * n * v) / (m + n), (v * (n - m) + 2 * m * u) / (m + n)

    left, middle = exchanged(1.0, 2.0, 0.5, 0.0)
    middle, right = exchanged(2.0, 3.0, middle, -0.5)
    by_id = line(place, velocity, mass, "overlap")
    energy = by_id.energy
    by_id.step()
    assert by_id.velocity[:, 0] == pytest.approx([left, middle, right], rel=1e-14)
    assert np.abs(by_id.velocity - by_time.velocity).max() > 0.1
    assert by_id.energy == pytest.approx(energy, rel=1e-15)
    assert by_time.energy == pytest.approx(energy, rel=1e-15)


def test_both_sides_at_the_same_time():
    def after(contacts):
        world = line([-1.5, 0.0, 1.5], [1.0, 0.0, -1.0], [1.0] * 3, contacts)
        world.run(3)
        return world.velocity[:, 0].tolist()

    # Equal balls swap velocities: both outer ones turn round, the middle one is still at the end.
    assert after("event") == [-1.0, 0.0, 1.0]
    # One pass by id leaves the left ball standing, and the middle one is through it before the next tick ...
    assert after("overlap") == [0.0, -1.0, 1.0]
    # ... unless the pair is judged at the beginning of that tick, where it still approaches.
    assert after("backtrack") == [-1.0, 0.0, 1.0]


@given(data=st.data(), count=st.integers(2, 8))
def test_a_long_tick_of_a_chain_is_its_exact_solution(data, count):
    numbers = st.integers(1, 64).map(lambda n: n / 16)
    gaps = data.draw(st.lists(numbers, min_size=count, max_size=count))
    velocity = data.draw(st.lists(st.integers(-64, 64).map(lambda n: n / 16), min_size=count, max_size=count))
    # Equal masses swap, and the outcome does not depend on ties.
    place = np.cumsum(np.array(gaps) + 1.0)
    chain = Chain.of(place.tolist(), velocity, [0.5] * count, [1.0] * count)
    # No quotient of two small integers: nothing happens at the very end.
    duration = 9.87654321
    chain.run(duration)
    world = line(place, velocity, [1.0] * count, "event", [0.5] * count)
    world.step(dt=duration)
    assert world.velocity[:, 0] == pytest.approx([float(v) for v in chain.velocity], abs=1e-12)
    assert world.position[:, 0] == pytest.approx([float(x) for x in chain.place], abs=1e-9)
