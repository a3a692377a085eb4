"""Peers run the very same scene, and refuse what they cannot run with a reason."""

from __future__ import annotations

import pytest

import kuglice as kg
from kuglice.lab.energy import energy
from kuglice.lab.methods import Method
from kuglice.lab.peers import PEERS
from kuglice.lab.running import CannotRunError, Running


@pytest.fixture(params=PEERS)
def make(request):
    def made(scene: kg.Scene) -> Running:
        try:
            return PEERS[request.param](scene)
        except CannotRunError as reason:
            if "not installed" in str(reason) or "not built" in str(reason):
                pytest.skip(str(reason))
            raise

    return made


def test_starts_from_the_same_state(make):
    scene = kg.scenes.gas(n=30)
    peer = make(scene)
    # Rapier computes in f32.
    assert peer.position == pytest.approx(scene.balls.position, rel=1e-6)
    assert peer.velocity == pytest.approx(scene.balls.velocity, rel=1e-6)


def test_moves_a_lone_ball_as_this_package_does(make):
    scene = kg.Scene(
        box=(0, 0, 9, 9),
        forces=[kg.Gravity(0.0, -1.0)],
        balls=kg.Balls(position=[(3, 5)], velocity=[(1, 2)], radius=1.0),
    )
    peer, world = make(scene), kg.World(scene, kg.Model(integrator="symplectic_euler", contacts="overlap"))
    peer.run(30)
    world.run(30)
    assert peer.position == pytest.approx(world.position, rel=1e-2)
    assert peer.velocity == pytest.approx(world.velocity, rel=1e-5)


def test_keeps_a_gas_in_its_box_and_most_of_its_energy(make):
    scene = kg.scenes.gas(n=100)
    peer = make(scene)
    start = energy(scene, peer)
    peer.run(120)
    # All pairs of a tick at once, as numpy wants it, and soft constraints, as in Rapier, lose what many have.
    assert 0.5 * start < energy(scene, peer) < 1.05 * start
    left, bottom, right, top = scene.box
    assert (peer.position > (left, bottom)).all()
    assert (peer.position < (right, top)).all()


def test_refuses_an_attractor_with_a_reason(make):
    with pytest.raises(CannotRunError, match=r"force|gravity"):
        make(kg.scenes.orbit())


def test_the_grid_sees_the_pairs_that_overlap_contacts_see():
    pytest.importorskip("numba")
    scene = kg.scenes.gas(n=500, packing=0.5)
    grid, world = PEERS["numba grid"](scene), kg.World(scene, Method("verlet", "overlap").model())
    grid.run(1)
    world.step()
    assert grid.collisions == world.collisions > 10
    assert grid.position == pytest.approx(world.position)
