"""Energy of a ball on a spring, against what the 2 x 2 matrix of each integrator says.

z = omega dt. One step multiplies (omega x, v) by a matrix of z alone: Hairer, Lubich and Wanner, Geometric
Numerical Integration, I.1 and IX.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import kuglice as kg
from kuglice.errors import DivergedError
from stability.worlds import make

OMEGA = 2.0
MASS = 3.0
SPRING = kg.Spring(0.0, 0.0, MASS * OMEGA**2)

phases = st.floats(0, 2 * math.pi)


def oscillator(integrator: str, z: float, phase: float = 0.0) -> kg.World:
    """Amplitude 1; a phase is where on its circle in (x, v / omega) the ball starts."""
    return make(
        [[math.cos(phase), 0.0]],
        [[OMEGA * math.sin(phase), 0.0]],
        mass=MASS,
        forces=[SPRING],
        tick_rate=OMEGA / z,
        integrator=integrator,
        contacts="overlap",
    )


def energies(world: kg.World, ticks: int) -> np.ndarray:
    found = [world.energy]
    for _ in range(ticks):
        world.step()
        found.append(world.energy)
    return np.array(found)


@given(z=st.floats(1e-3, 10), phase=phases)
def test_explicit_euler_multiplies_energy_by_one_plus_z_squared(z, phase):
    # Its eigenvalues are 1 +- i z, so |.|^2 = 1 + z^2 at every step and phase.
    energy = energies(oscillator("euler", z, phase), 20)
    assert energy[1:] / energy[:-1] == pytest.approx(1 + z * z, rel=1e-9)


def test_no_tick_is_short_enough_for_explicit_euler():
    # (1 + z^2)^(t / dt) is about exp(omega z t).
    for z in (0.1, 0.01, 0.001):
        world = oscillator("euler", z)
        start = world.energy
        world.run(round(1 / z**2))
        assert world.energy / start == pytest.approx(math.e, rel=z)


@given(z=st.floats(0.01, 1.99), phase=phases)
def test_symplectic_euler_stays_in_a_band_below_2(z, phase):
    # It keeps Q = (omega x)^2 - z (omega x) v + v^2 (I.1.9), and Q lies within (1 +- z / 2) times 2 E / m.
    energy = energies(oscillator("symplectic_euler", z, phase), 2000)
    band = (1 + z / 2) / (1 - z / 2)
    assert energy.max() / energy[0] <= band * (1 + 1e-9)
    assert energy.min() / energy[0] >= (1 - 1e-9) / band


@given(z=st.floats(0.01, 1.99), phase=phases)
def test_verlet_stays_in_a_band_below_2(z, phase):
    # Velocity Verlet keeps v^2 + (1 - z^2 / 4) (omega x)^2.
    energy = energies(oscillator("verlet", z, phase), 2000)
    band = 1 / (1 - z * z / 4)
    assert energy.max() / energy[0] <= band * (1 + 1e-9)
    assert energy.min() / energy[0] >= (1 - 1e-9) / band


def test_the_bands_are_reached():
    # Over many steps the phase comes close to every place of the ellipse, so the bounds are sharp.
    for z in (0.5, 1.1, 1.9):
        symplectic = energies(oscillator("symplectic_euler", z, math.pi / 4), 20_000)
        assert symplectic.max() / symplectic.min() == pytest.approx((1 + z / 2) / (1 - z / 2), rel=0.01)
        verlet = energies(oscillator("verlet", z), 20_000)
        assert verlet.max() / verlet.min() == pytest.approx(1 / (1 - z * z / 4), rel=0.01)


@pytest.mark.parametrize("integrator", ["symplectic_euler", "verlet"])
@pytest.mark.parametrize("z", [2.001, 2.1, 3.0])
def test_both_diverge_above_2(integrator, z):
    # Both have trace 2 - z^2 and determinant 1; the larger eigenvalue is the growth of amplitude per step.
    growth = (z * z - 2 + z * math.sqrt(z * z - 4)) / 2
    steps = math.ceil(10 / math.log(growth))
    world = oscillator(integrator, z, 1.0)
    world.run(steps)
    before = world.energy
    world.run(steps)
    assert world.energy / before == pytest.approx(growth ** (2 * steps), rel=1e-3)


@given(z=st.floats(0.3, 4.0), phase=phases)
def test_rk4_multiplies_energy_by_its_stability_function(z, phase):
    # |R(i z)|^2 = 1 - z^6 / 72 + z^8 / 576, with R(s) = 1 + s + s^2 / 2 + s^3 / 6 + s^4 / 24.
    energy = energies(oscillator("rk4", z, phase), 20)
    assert energy[1:] / energy[:-1] == pytest.approx(1 - z**6 / 72 + z**8 / 576, rel=1e-9)


def test_dissipation_of_rk4_is_of_sixth_order():
    def lost(z: float) -> float:
        energy = energies(oscillator("rk4", z), 10)
        return 1 - energy[-1] / energy[0]

    zs = np.array([0.05, 0.1, 0.2])
    orders = np.diff(np.log([lost(z) for z in zs])) / np.diff(np.log(zs))
    assert orders == pytest.approx(6, abs=0.05)


def test_rk4_is_stable_below_two_root_two_only():
    # z^8 / 576 outgrows z^6 / 72 at z^2 = 8.
    border = 2 * math.sqrt(2)
    below, above = oscillator("rk4", border * 0.999, 1.0), oscillator("rk4", border * 1.001, 1.0)
    start = below.energy
    below.run(10_000)
    above.run(10_000)
    assert below.energy < 1e-10 * start
    assert above.energy > 1e10 * start


@pytest.mark.parametrize("integrator", ["euler", "symplectic_euler", "verlet", "rk4"])
def test_divergence_to_infinity_is_an_error_that_keeps_the_last_whole_tick(integrator):
    world = oscillator(integrator, 10.0, 1.0)
    with pytest.raises(DivergedError, match=r"ball 0 is no longer finite.*unstable"):
        world.run(1_000)
    tick, fingerprint = world.tick, world.state_hash
    assert 0 < tick < 1_000
    assert np.isfinite(world.position).all()
    with pytest.raises(DivergedError, match=f"tick {tick}"):
        world.step()
    assert (world.tick, world.state_hash) == (tick, fingerprint)
