"""Loops: every nanosecond becomes ticks, waits, or is counted as skipped."""

import logging
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from kuglice.loop import Fixed, Interpolated, Variable

SECOND = 1_000_000_000
FIXED = [Fixed, Interpolated]


class Clock:
    """Tells the time it is set to."""

    def __init__(self) -> None:
        self.now = 10**15

    def __call__(self) -> int:
        return self.now


def world_of(rate: float = 60.0) -> kg.World:
    scene = kg.scenes.gas(n=12, packing=0.3)
    return kg.World(scene.model_copy(update={"tick_rate": rate}))


def run(loop, clock, nanoseconds):
    clock.now += nanoseconds
    return loop.frame()


@given(
    st.lists(st.integers(0, SECOND // 4), max_size=30),
    st.sampled_from([60.0, 64.0, 59.94, 1000 / 3, 144.0]),
    st.sampled_from(FIXED),
)
def test_the_number_of_ticks_is_the_time_that_has_passed(frames, rate, kind):
    clock = Clock()
    loop = kind(world_of(rate), clock=clock)
    total = 0
    for nanoseconds in frames:
        frame = run(loop, clock, nanoseconds)
        total += nanoseconds
        exact = Fraction(total, SECOND) * Fraction(rate)
        assert loop.world.tick == int(exact)
        assert frame.alpha == pytest.approx(float(exact - int(exact)), abs=1e-9)
        assert 0 <= frame.alpha < 1
        assert frame.skipped == 0


@pytest.mark.parametrize("kind", FIXED)
def test_bits_do_not_depend_on_the_pattern_of_frames(kind):
    patterns = [
        [SECOND // 60] * 120,
        [1, SECOND // 7, SECOND // 31] * 12,
        [SECOND // 240] * 480,
        [SECOND // 4] * 8,
    ]
    hashes = {}
    for pattern in patterns:
        clock = Clock()
        loop = kind(world_of(), clock=clock)
        for nanoseconds in pattern:
            run(loop, clock, nanoseconds)
            tick = loop.world.tick
            assert hashes.setdefault(tick, loop.world.state_hash) == loop.world.state_hash
    reference = world_of()
    reference.run(loop.world.tick)
    assert reference.state_hash == loop.world.state_hash


def test_sixty_frames_a_second_never_drift():
    clock = Clock()
    loop = Fixed(world_of(), clock=clock)
    start = clock.now
    for frame in range(1, 3601):
        clock.now = start + frame * SECOND // 60
        loop.frame()
    assert loop.world.tick == 3600


@pytest.mark.parametrize("kind", [Variable, Fixed, Interpolated])
def test_a_stall_is_cut_counted_reported_and_survived(kind, caplog):
    clock = Clock()
    loop = kind(world_of(), clock=clock, longest=0.25)
    run(loop, clock, SECOND // 10)
    with caplog.at_level(logging.WARNING, logger="kuglice.loop"):
        frame = run(loop, clock, 2 * SECOND)
    assert frame.elapsed == pytest.approx(2.0)
    assert frame.skipped == pytest.approx(1.75)
    assert loop.stalls == 1
    assert loop.skipped == pytest.approx(1.75)
    assert "1.750 s" in caplog.text
    after = run(loop, clock, SECOND // 10)
    assert after.skipped == 0
    assert loop.stalls == 1
    assert loop.world.time == pytest.approx(0.45, abs=1 / 60)


@pytest.mark.parametrize("kind", [Variable, Fixed, Interpolated])
def test_a_clock_that_goes_back_stops_time_and_no_more(kind):
    clock = Clock()
    loop = kind(world_of(), clock=clock)
    run(loop, clock, SECOND // 10)
    time = loop.world.time
    frame = run(loop, clock, -SECOND)
    assert (frame.ticks, frame.elapsed) == (0, 0.0)
    assert loop.world.time == time
    assert run(loop, clock, SECOND // 10).skipped == 0


def test_a_variable_step_is_as_long_as_the_frame():
    clock = Clock()
    loop = Variable(world_of(), clock=clock)
    for nanoseconds in (1_000_000, 50_000_000, 0, 7_000_000):
        run(loop, clock, nanoseconds)
    assert loop.world.tick == 3
    assert loop.world.time == pytest.approx(0.058)


@pytest.mark.parametrize("kind", [Variable, Fixed, Interpolated])
def test_inputs_are_asked_for_before_every_tick(kind):
    clock = Clock()
    asked = []

    def inputs(world):
        asked.append(world.tick)
        return [kg.Kick(ball=int(world.id[0]), vx=0.1, vy=0)]

    loop = kind(world_of(), inputs=inputs, clock=clock)
    for _ in range(5):
        run(loop, clock, SECOND // 20)
    assert asked == list(range(loop.world.tick))
    assert loop.world.inputs_applied == loop.world.tick > 0


def test_drawn_is_between_the_last_two_states():
    clock = Clock()
    loop = Interpolated(world_of(), clock=clock)
    for nanoseconds in (SECOND // 100, SECOND // 35, SECOND // 9, SECOND // 77, 3):
        frame = run(loop, clock, nanoseconds)
        reference = world_of()
        reference.run(max(loop.world.tick - 1, 0))
        before = reference.position
        if loop.world.tick:
            reference.step()
        assert (loop.position == frame.alpha * reference.position + (1 - frame.alpha) * before).all()


def test_the_previous_state_is_a_copy():
    clock = Clock()
    loop = Interpolated(world_of(), clock=clock)
    run(loop, clock, SECOND // 10)
    held = loop.previous.state_hash
    assert loop.previous.tick == loop.world.tick - 1
    loop.world.run(10)
    assert loop.previous.state_hash == held


def test_balls_that_come_and_go_are_drawn_by_their_id():
    clock = Clock()
    world = world_of()
    gone = int(world.id[2])
    script = {1: [kg.Remove(ball=gone), kg.Spawn(sequence=1, x=1, y=1, radius=0.1, mass=1)]}
    loop = Interpolated(world, inputs=lambda each: script.get(each.tick, []), clock=clock)
    frame = run(loop, clock, SECOND * 5 // 120)
    assert frame.ticks == 2
    assert frame.alpha == pytest.approx(0.5)
    drawn = loop.position
    assert len(drawn) == 12
    kept = np.isin(loop.previous.id, loop.world.id)
    middle = 0.5 * loop.world.position[:-1] + 0.5 * loop.previous.position[kept]
    assert drawn[:-1] == pytest.approx(middle, abs=1e-6)
    assert (drawn[-1] == loop.world.position[-1]).all()


@pytest.mark.parametrize("longest", [0.0, -1.0, float("inf"), float("nan")])
def test_a_longest_frame_of_nothing_or_without_end_is_refused(longest):
    with pytest.raises(kg.errors.LimitError, match=f"longest = {longest}: must be finite and greater than 0"):
        Fixed(world_of(), longest=longest)
