"""The compiled packing of regions, as Python sees it."""

import numpy as np
import pytest

import kuglice as kg
from kuglice import _core
from kuglice.errors import ProtocolError

BOX = (0.0, 0.0, 40.0, 20.0)


def regions(depth: int = 2, **changes) -> _core.Regions:
    given = {"box": BOX, "depth": depth, "position_quantum": 2**-8, "velocity_quantum": 2**-6, "shapes": []}
    return _core.Regions(**(given | changes))


def test_the_nodes_together_tell_every_ball_once_within_half_a_quantum():
    world = kg.World(kg.scenes.rain(n=300))
    world.run(30)
    packer = regions(depth=3, box=world.scene.box, shapes=[(world.radius[0], world.mass[0])])
    packed, left_out = world.regions(packer, range(64))
    told = [packer.unpack(data, 1000) for data in packed]
    order = np.argsort(np.concatenate([one[0] for one in told]))
    ids, position, velocity, radius, mass = (np.concatenate(part)[order] for part in zip(*told, strict=True))
    assert left_out == 0
    assert (ids == world.id).all()
    assert np.abs(position - world.position).max() <= 2**-9
    assert np.abs(velocity - world.velocity).max() <= 2**-7
    assert np.abs(radius / world.radius - 1).max() < 1e-7
    assert np.abs(mass / world.mass - 1).max() < 1e-6
    for node, one in enumerate(told):
        assert (packer.node(world.position)[np.isin(world.id, one[0])] == node).all()


def test_a_large_world_out_of_id_order_in_memory_is_told_in_id_order():
    world = kg.World(kg.scenes.gas(n=3000))
    world.run(5)
    with world.view() as balls:
        assert (np.diff(balls.id.astype(np.int64)) < 0).any()
    packer = regions(box=world.scene.box)
    ids = packer.unpack(world.regions(packer, [6])[0][0], 3000)[0]
    assert (np.diff(ids.astype(np.int64)) > 0).all()
    assert set(ids) == set(world.id[packer.node(world.position) == 6])


def test_what_is_no_region_is_refused():
    for data in (b"", b"\x01", b"\xff" * 40, b"\x00\x00"):
        with pytest.raises(ProtocolError, match="region: "):
            regions().unpack(data, 100)
    with pytest.raises(ProtocolError, match="3 balls, at most 2"):
        regions().unpack(b"\x03", 2)


@pytest.mark.parametrize(
    "wrong",
    [
        {"depth": 9},
        {"box": (0.0, 0.0, 0.0, 1.0)},
        {"position_quantum": 0.0},
        {"velocity_quantum": float("nan")},
        {"shapes": [(1.0, 1.0)] * 257},
    ],
)
def test_numbers_that_make_no_grid_are_refused(wrong):
    with pytest.raises(ProtocolError):
        regions(**wrong)
