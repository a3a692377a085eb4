"""Without what a tick that could not be made is tried again."""

from __future__ import annotations

from kuglice import World
from kuglice.budget import tick_budget
from kuglice.inputs import Attract, Join, Kick, Thrust
from kuglice_server.attempts import attempts
from server.small_arena import small_arena


def test_new_inputs_go_first_then_what_is_held_and_the_servers_own_never() -> None:
    world = World(small_arena())
    world.step([Join(client=client, x=1.0, y=3.0 * client, radius=0.4, mass=2.0) for client in (1, 2)])
    world.step(
        [
            Thrust(client=1, sequence=1, x=5.0, y=0.0),
            Attract(client=2, sequence=1, x=3.0, y=3.0, strength=9.0),
        ]
    )
    own, new = [Join(client=3)], [Kick(client=1, sequence=2, vx=1.0, vy=0.0)]

    tried, budgets, losses = zip(*attempts(world, own, new), strict=True)

    assert tried[0] == own + new
    assert tried[1] == own
    assert losses[1] == "1 inputs are left out"
    assert all(inputs[: len(own)] == own for inputs in tried)
    assert set(budgets[:-1]) == {tick_budget(world)}
    assert budgets[-1] is None
    world.step(tried[2])
    assert [strength for *_, strength in world.held] == [0.0] * len(world.held)
    assert all((x, y) == (0.0, 0.0) for _, kind, x, y, _ in world.held if kind == "thrust")
