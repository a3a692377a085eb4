"""Energy under uniform gravity: Verlet and RK4 are exact, both Euler methods drift by a known amount."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from stability.worlds import make

MASS = 2.0
RADIUS = 0.5


def ball(integrator: str, gravity: float, h: float, *, box=None, height: float = 0.0, **given) -> kg.World:
    return make(
        [[0.0, height]],
        [[1.0, 2.0]] if box is None else [[0.0, 0.0]],
        radius=RADIUS,
        mass=MASS,
        forces=[kg.Gravity(0.0, -gravity)],
        tick_rate=1 / h,
        box=box,
        integrator=integrator,
        contacts=given.pop("contacts", "overlap"),
        **given,
    )


def gains(world: kg.World, ticks: int) -> np.ndarray:
    energy = [world.energy]
    for _ in range(ticks):
        world.step()
        energy.append(world.energy)
    return np.diff(energy)


@given(gravity=st.floats(0.1, 100), h=st.floats(1e-3, 1.0))
def test_explicit_euler_gains_and_symplectic_euler_loses_the_same_each_step(gravity, h):
    # Delta E = m v . g h + 1/2 m g^2 h^2 - m g . (v or v + g h) h: +1/2 m g^2 h^2 or -1/2 m g^2 h^2.
    step = 0.5 * MASS * gravity**2 * h**2
    rounding = 1e-13 * MASS * (2 + gravity * h * 50) ** 2
    assert gains(ball("euler", gravity, h), 50) == pytest.approx(step, rel=1e-6, abs=rounding)
    assert gains(ball("symplectic_euler", gravity, h), 50) == pytest.approx(-step, rel=1e-6, abs=rounding)


@pytest.mark.parametrize("integrator", ["verlet", "rk4"])
@given(gravity=st.floats(0.1, 100), h=st.floats(1e-3, 1.0))
def test_verlet_and_rk4_are_exact(integrator, gravity, h):
    # Both reproduce x + v t + g t^2 / 2, so gravity alone cannot rank them.
    world = ball(integrator, gravity, h)
    world.run(50)
    t = 50 * h
    assert world.position[0] == pytest.approx([t, 2 * t - gravity * t**2 / 2], rel=1e-12, abs=1e-11)
    assert world.velocity[0] == pytest.approx([1.0, 2 - gravity * t], rel=1e-12, abs=1e-11)


def bounced(
    integrator: str, drop: float, h: float, contacts: str, bounces: int = 1
) -> tuple[float, kg.World]:
    """Energy after the first bounce, and the world `bounces` later; gravity 10, floor at 0."""
    box = (-5.0, 0.0, 5.0, 100.0)
    world = ball(integrator, 10.0, h, box=box, height=drop + RADIUS, contacts=contacts)
    while world.wall_hits < 1:
        world.step()
    energy = world.energy
    while world.wall_hits < 1 + bounces:
        world.step()
    return energy, world


@pytest.mark.parametrize("h", [1 / 60, 1 / 120, 1 / 240])
@pytest.mark.parametrize("drop", [5.0, 20.0])
def test_symplectic_euler_loses_m_g_h_v_per_bounce_on_an_elastic_floor(h, drop):
    # 1/2 m g^2 h^2 per step, 2 v / (g h) steps per flight, nothing at the flip; v = sqrt(2 g drop).
    before, world = bounced("symplectic_euler", drop, h, "overlap")
    speed = np.sqrt(2 * 10.0 * drop)
    assert before - world.energy == pytest.approx(MASS * 10.0 * h * speed, rel=0.1)


@pytest.mark.parametrize("contacts", ["overlap", "backtrack", "event"])
def test_verlet_keeps_its_energy_on_an_elastic_floor(contacts):
    before, world = bounced("verlet", 5.0, 1 / 60, contacts, bounces=100)
    assert world.energy == pytest.approx(before, rel=1e-12)


def test_event_bounces_on_time_and_overlap_late():
    # Period of a bounce from height d: 2 sqrt(2 d / g). After 100 bounces `overlap` is off by tens of ticks.
    drop, h = 5.0, 1 / 64
    period = 2 * np.sqrt(2 * drop / 10.0)
    late = {}
    for contacts in ("overlap", "event"):
        world = ball("verlet", 10.0, h, box=(-5, 0, 5, 100), height=drop + RADIUS, contacts=contacts)
        while world.wall_hits < 100:
            world.step()
        late[contacts] = world.time - (99 + 0.5) * period
    assert 0 <= late["event"] <= h
    assert abs(late["overlap"]) > 10 * h
