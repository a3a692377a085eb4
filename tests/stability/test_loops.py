"""What frame times do to a world: to a variable step everything, to a fixed step nothing."""

from __future__ import annotations

import logging
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kuglice as kg
from kuglice.loop import Fixed, Interpolated, Variable
from stability.worlds import make

SECOND = 1_000_000_000
RATES = [20, 60, 144]
"""Frames per second."""


class Clock:
    """Tells the time it is set to."""

    def __init__(self) -> None:
        self.now = 5 * SECOND

    def __call__(self) -> int:
        return self.now


def play(kind, world: kg.World, frames: list[int], longest: float = 0.25) -> None:
    """Frames of that many nanoseconds each."""
    clock = Clock()
    loop = kind(world, clock=clock, longest=longest)
    for nanoseconds in frames:
        clock.now += nanoseconds
        loop.frame()


def cut(duration: float, rate: int) -> list[int]:
    """Frames of one rate whose sum is the duration to the nanosecond."""
    ends = [round(SECOND * (index + 1) / rate) for index in range(round(duration * rate))]
    return [end - start for start, end in zip([0, *ends], ends, strict=False)]


def falling() -> kg.World:
    return make(
        [[0.0, 0.0]],
        [[1.0, 5.0]],
        forces=[kg.Gravity(0.0, -10.0)],
        integrator="symplectic_euler",
        contacts="overlap",
    )


@pytest.mark.parametrize("rate", RATES)
def test_a_variable_step_falls_as_far_as_the_frame_rate_says(rate):
    # Symplectic Euler: y = v t - 1/2 g t^2 - 1/2 g h t. At 20 frames per second that is 0.5 too low after 2 s.
    world = falling()
    play(Variable, world, cut(2.0, rate))
    assert world.position[0, 1] == pytest.approx(5 * 2 - 5 * 4 - 5 * 2 / rate, abs=1e-6)


def test_a_variable_step_jumps_through_what_a_faster_screen_would_have_hit():
    # r1 + r2 = 1 at 40 per second: 20 frames per second move 2 a frame, 144 move 0.28.
    def speed_after(rate: int, contacts: str) -> float:
        world = make(
            [[0.0, 0.0], [-3.9, 0.0]], [[0.0, 0.0], [40.0, 0.0]], mass=[math.inf, 1.0], contacts=contacts
        )
        play(Variable, world, cut(1.0, rate))
        return float(world.velocity[1, 0])

    assert [speed_after(rate, "overlap") for rate in RATES] == [40.0, -40.0, -40.0]
    assert [speed_after(rate, "event") for rate in RATES] == [-40.0, -40.0, -40.0]


GAS = kg.scenes.gas(n=40, packing=0.4)


def crowd(tick_rate: float = 60.0) -> kg.World:
    scene = GAS.model_copy(update={"tick_rate": tick_rate})
    return kg.World(scene, kg.Model(integrator="verlet", contacts="overlap"))


def test_a_variable_step_ends_in_another_state_at_each_frame_rate():
    states = set()
    for rate in RATES:
        world = crowd()
        play(Variable, world, cut(3.0, rate))
        assert world.time == pytest.approx(3.0, abs=1e-6)
        states.add(tuple(world.position.round(3).ravel()))
    assert len(states) == len(RATES)


@pytest.mark.parametrize("kind", [Fixed, Interpolated])
def test_a_fixed_step_ends_in_the_same_bits_at_each_frame_rate(kind):
    states = set()
    for rate in RATES:
        world = crowd()
        play(kind, world, cut(3.0, rate))
        assert world.tick == 180
        states.add(world.snapshot())
    assert len(states) == 1


@settings(max_examples=40)
@given(
    frames=st.lists(st.integers(0, SECOND // 5), max_size=60),
    tick_rate=st.sampled_from([30.0, 60.0, 59.94, 128.0]),
    kind=st.sampled_from([Fixed, Interpolated]),
)
def test_a_fixed_step_does_not_know_the_pattern_of_frames(frames, tick_rate, kind):
    patterned, plain = crowd(tick_rate), crowd(tick_rate)
    play(kind, patterned, frames)
    plain.run(patterned.tick)
    assert patterned.snapshot() == plain.snapshot()
    # Not one nanosecond is lost or made: ticks = floor(time x rate).
    assert patterned.tick == sum(frames) * int(tick_rate * 100) // (100 * SECOND)


@pytest.mark.parametrize("kind", [Fixed, Interpolated])
@pytest.mark.parametrize("stall", [10, 3600])
def test_a_stall_neither_spirals_nor_loses_time_silently(kind, stall, caplog):
    clock, world = Clock(), crowd()
    loop = kind(world, clock=clock, longest=0.25)
    clock.now += SECOND
    with caplog.at_level(logging.WARNING):
        clock.now += (stall - 1) * SECOND
        frame = loop.frame()
    # 0.25 s at 60 ticks per second is caught up with, the rest is skipped and told in three places.
    assert frame.ticks == world.tick == 15
    assert frame.skipped == loop.skipped == stall - 0.25
    assert frame.elapsed == stall
    assert loop.stalls == 1
    assert f"{stall - 0.25:.3f} s of it are skipped" in caplog.text
    # The debt is gone: the next frame is like any other, and every second is accounted for.
    clock.now += SECOND // 20
    frame = loop.frame()
    assert (frame.ticks, frame.skipped) == (3, 0.0)
    assert world.time + frame.alpha / 60 + loop.skipped == pytest.approx(stall + 0.05, abs=1e-9)


def test_even_frames_that_are_always_late_do_not_spiral():
    # Each frame takes longer than the last, as if ticks cost more than real time: work per frame stays bounded.
    clock, world = Clock(), crowd()
    loop = Fixed(world, clock=clock, longest=0.25)
    elapsed, ticks = 0, []
    for index in range(60):
        late = (index + 1) * SECOND // 10
        clock.now += late
        elapsed += late
        ticks.append(loop.frame().ticks)
    assert max(ticks) == 15
    assert world.tick == sum(ticks)
    assert world.tick / 60 + loop.skipped == pytest.approx(elapsed / SECOND, abs=1 / 60)


def test_a_variable_step_bounds_a_stall_too():
    clock, world = Clock(), crowd()
    loop = Variable(world, clock=clock, longest=0.25)
    clock.now += 10 * SECOND
    frame = loop.frame()
    assert (frame.ticks, frame.skipped) == (1, 9.75)
    assert world.time == 0.25
