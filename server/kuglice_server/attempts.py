"""What is tried, one after the other, when a tick cannot be made: a server never dies of what clients send.

Every input was checked when it came in, but only alone: together, or held for long enough, inputs that are each within
their bounds can still ask for more than a tick can give (errors.StepError).
"""

from __future__ import annotations

from collections.abc import Iterator

from kuglice import World
from kuglice.inputs import Attract, Input, Thrust

__all__ = ["attempts"]


def attempts(world: World, authored: list[Input], inputs: list[Input]) -> Iterator[tuple[list[Input], str]]:
    """Inputs to try, and what trying them gives up. `authored` are the server's own, which stay."""
    yield authored + inputs, "nothing is left out"
    yield authored, f"{len(inputs)} inputs are left out"
    released = list(_released(world))
    yield authored + released, f"{len(inputs)} inputs are left out and {len(released)} held ones are released"


def _released(world: World) -> Iterator[Input]:
    for client, kind, x, y, _ in world.held:
        if kind == "attract":
            yield Attract(client=client, x=x, y=y, strength=0.0)
        else:
            yield Thrust(client=client, x=0.0, y=0.0)
