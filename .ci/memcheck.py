"""What .ci/memcheck runs under valgrind: every use of memory that a world lends, in the orders that could go wrong;
balls so many that their arrays are asked for in large pages; snapshots of any length."""

import gc
from collections.abc import Callable

import numpy as np

from kuglice import _core
from kuglice.errors import LentError

COUNT = 50
MANY = 270_000
"""Balls whose positions take more than 4 MiB: see large_pages.rs."""


def box(count: int) -> tuple[_core.Rules, _core.Model]:
    """Room for so many balls side by side."""
    rules = _core.Rules(
        box=(0.0, 0.0, count + 10.0, 10.0), walls=True, restitution=1.0, tick_rate=60.0, forces=[]
    )
    return rules, _core.Model(integrator="verlet", contacts="overlap", broadphase="loose_quadtree")


def world(count: int = COUNT) -> _core.World:
    """Some balls in a box, whose memory is large enough to come and go as blocks of its own."""
    rules, model = box(count)
    place = np.arange(count, dtype=float)
    return _core.World(
        rules,
        model,
        position=np.stack([1.0 + place, np.full(count, 5.0)], axis=1),
        velocity=np.ones((count, 2)),
        radius=np.full(count, 0.4),
        mass=np.ones(count),
    )


def total(lease: _core.Lease) -> float:
    """Reads every byte that is lent."""
    arrays = (lease.position, lease.velocity, lease.radius, lease.mass, lease.id)
    return float(sum(array.sum() for array in arrays))


def refused(change: Callable[..., None], *arguments: object) -> None:
    """A change of a lent world."""
    try:
        change(*arguments)
    except LentError:
        return
    raise AssertionError("a lent world has changed")


def main() -> None:
    """Raises what is wrong; valgrind names what nobody can raise."""
    one = world()
    lease = one.lend()
    before = total(lease)

    # A lent world refuses to change, and its arrays stay what they were.
    refused(one.step, b"")
    refused(one.run, 1)
    refused(one.copy_from, world())
    assert total(lease) == before

    # An array, and what is cut from it, outlive their lease and the last name of their world.
    position, row = lease.position, lease.position[7]
    lease.end()
    del lease, one
    gc.collect()
    scraps = [world() for _ in range(3)]
    assert position[7, 0] == row[0] == 8.0
    del position, row, scraps
    gc.collect()

    # What was given back is free to move: more balls than before fit no longer where they were.
    two = world()
    with_lease = two.lend()
    total(with_lease)
    with_lease.end()
    two.run(3)
    again = two.lend()
    assert np.isfinite(total(again))
    again.end()

    # Memory in large pages is used to both its ends, grows, and is given back.
    many = world(MANY)
    many.run(2)
    copy = many.clone()
    many.run(1)
    copy.copy_from(many)
    assert copy.state_hash == many.state_hash
    lease = many.lend()
    assert total(lease) == total(copy.lend())
    del many, copy, lease
    gc.collect()

    # A snapshot fills Python's bytes to their last, and what was written there says so.
    for count in (*range(5), COUNT, MANY):
        whole = world(count)
        whole.run(1)
        data = whole.snapshot()
        again = _core.World.restore(*box(count), data)
        assert again.state_hash == whole.state_hash
        assert again.snapshot() == data
    del whole, again, data
    gc.collect()

    # Nothing to lend is lent as well.
    nobody = _core.World(
        _core.Rules(box=(0.0, 0.0, 1.0, 1.0), walls=True, restitution=1.0, tick_rate=60.0, forces=[]),
        _core.Model(integrator="verlet", contacts="overlap", broadphase="brute"),
        position=np.empty((0, 2)),
        velocity=np.empty((0, 2)),
        radius=np.empty(0),
        mass=np.empty(0),
    )
    empty = nobody.lend()
    assert len(empty.id) == 0
    del nobody
    gc.collect()
    assert total(empty) == 0.0


if __name__ == "__main__":
    main()
