"""What is tried, one after the other, when a tick cannot be made: a server never dies of what clients send.

Every input was checked when it came in, but only alone: together, or held for long enough, inputs that are each within
their bounds can still ask for more than a tick can give (errors.StepError), or for more than it should take: a tick has
a budget of its own here, well below what the step would go on with, kept or broken by the same ticks everywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from kuglice import World
from kuglice.budget import tick_budget
from kuglice.inputs import OWNER, Attract, Input, Remove, Thrust

__all__ = ["Attempt", "attempts"]


class Attempt(NamedTuple):
    """Inputs to try, how many pairs they may take (None: as many as the step allows), and what trying them gives up."""

    inputs: list[Input]
    budget: int | None
    loss: str


def attempts(world: World, authored: list[Input], inputs: list[Input]) -> Iterator[Attempt]:
    """`authored` inputs are the server's own, which stay.

    The last attempt leaves nothing of clients' doing that could be at fault: what cannot be made then is the scene's.
    """
    most = tick_budget(world)
    yield Attempt(authored + inputs, most, "nothing is left out")
    yield Attempt(authored, most, f"{len(inputs)} inputs are left out")
    released = list(_released(world))
    loss = f"{len(inputs)} inputs are left out and {len(released)} held ones are released"
    yield Attempt(authored + released, most, loss)
    for removed in (list(_removed(world, only_overlapping=True)), list(_removed(world))):
        yield Attempt(
            authored + released + removed,
            most,
            f"{loss}, and {len(removed)} balls that came later are removed",
        )
    yield Attempt(authored + released, None, f"{loss}, and it took more than {most} pairs")


def _released(world: World) -> Iterator[Input]:
    for client, kind, x, y, _ in world.held:
        if kind == "attract":
            yield Attract(client=client, x=x, y=y, strength=0.0)
        else:
            yield Thrust(client=client, x=0.0, y=0.0)


def _removed(world: World, *, only_overlapping: bool = False) -> Iterator[Input]:
    """Removals of the balls that are neither the scene's own nor a player's."""
    players = {ball for _, ball in world.players}
    balls = set(world.overlapping().ravel().tolist()) if only_overlapping else set(world.id.tolist())
    later = [ball for ball in sorted(balls - players) if ball >= len(world.scene.balls)]
    for sequence, ball in enumerate(later):
        yield Remove(client=OWNER, sequence=sequence, ball=ball)
