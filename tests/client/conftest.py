"""An authority for clients to follow, without a network: the same messages, by hand."""

from __future__ import annotations

import pytest

from kuglice import World
from kuglice.inputs import Input, Join, pack
from kuglice.protocol import History, StretchedTick, Tick
from server.small_arena import small_arena

EPOCH = 5


class Authority:
    """The server's world; every tick it did is kept."""

    def __init__(self) -> None:
        self.world = World(small_arena())
        self.ticks: list[StretchedTick] = []
        self.step([Join(client=1, sequence=1, x=1, y=1, radius=0.4, mass=2)])
        self.step([Join(client=2, sequence=2, x=19, y=9, radius=0.4, mass=2)])

    def step(self, inputs: list[Input] = []) -> StretchedTick:  # noqa: B006 - never changed
        records = pack(sorted(inputs, key=lambda one: (one.client, one.sequence)))
        tick = self.world.tick
        self.world.step(records)
        self.ticks.append(StretchedTick(tick, records, self.world.state_hash))
        return self.ticks[-1]

    def message(self, end: int | None = None, repeat: int = 1) -> Tick:
        """The tick message before state `end`, the newest by default, with `repeat` ticks."""
        end = end or len(self.ticks)
        told = self.ticks[max(0, end - repeat) : end]
        return Tick.of(EPOCH, told)

    def history(self, first: int, end: int) -> History:
        """The answer of the server's history for the ticks first .. end - 1."""
        return History.of(EPOCH, [entry for entry in self.ticks if first <= entry.tick < end])


@pytest.fixture
def authority() -> Authority:
    return Authority()
