"""A pile under drag or a spring gained energy in `event`, up to 15 kJ in one tick.

Forces that vary were kicks before and after the straight paths of a tick. A contact of balls that parted, while their
paths still led into each other, parked the velocities of both until the tick ended. Balls that are pressed together
meet hundreds of times per tick, and what was parked added up: at restitution 1, too. Now such a tick moves balls along
the parabolas of what pulls them at its start; nothing is parked.
"""

from __future__ import annotations

import pytest

import kuglice as kg
from kuglice.layout import RandomGroup

RATE = 60.0
GRAVITY = 10.0
PULLS = {
    "gravity": [kg.Gravity(0.0, -GRAVITY)],
    "a spring": [kg.Spring(3.0, 2.0, 4.0)],
}


@pytest.mark.parametrize("restitution", [0.5, 0.8, 1.0])
@pytest.mark.parametrize("pull", PULLS)
def test_a_pile_under_drag_gains_no_energy(pull, restitution):
    scene = kg.Scene(
        box=(0, 0, 6, 4),
        tick_rate=RATE,
        restitution=restitution,
        forces=(*PULLS[pull], kg.Drag(2.0)),
        groups=(RandomGroup(count=66, radius=0.25, speed=3.0, seed=1),),
    )
    world = kg.World(scene, kg.Model(contacts="event"))
    # Crowded balls part no slower than at an eighth of what the pull gains in a tick, even where they met more slowly.
    parting = 0.125 * GRAVITY / RATE
    most = 0.5 * world.mass.sum() * parting**2
    gains = []
    for _ in range(120):
        before = world.energy
        world.run(1)
        gains.append(world.energy - before)
    assert max(gains) < most
