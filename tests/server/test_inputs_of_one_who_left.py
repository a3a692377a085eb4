"""Regression: an attraction that was promised for a later tick acted although its client had left before.

It was held from then on, by nobody who could have let it go: the balls fell towards that point for the rest of the
game.
"""

from __future__ import annotations

import pytest

from kuglice.inputs import Attract, Spawn
from server.test_intake import SESSION, Desk


@pytest.fixture
def desk():
    return Desk()


def tick(desk: Desk) -> list:
    """As in the server: who leaves does so before the inputs of the tick are looked at."""
    authored = desk.players.authored(desk.world)
    inputs = desk.intake.due(desk.world.tick)
    desk.tell()
    desk.world.step(authored + inputs)
    return inputs


@pytest.mark.parametrize("later", [1, 2, 5])
def test_what_one_who_has_left_was_promised_does_not_act(desk, later):
    begin = desk.world.tick
    desk.send(
        (1, begin + later, Attract(x=5.0, y=5.0, strength=1.0)),
        (2, begin + later, Spawn(x=9.0, y=9.0, radius=0.1, mass=1.0)),
    )
    balls = desk.world.count
    desk.players.leave("ana", SESSION)
    acted = [one for _ in range(later + 2) for one in tick(desk)]
    assert acted == []
    assert (desk.world.held, desk.world.count) == ([], balls - 1)
    assert desk.counters["left_out"] == 2
    assert (desk.player.accepted, desk.player.refused) == (0, 2)


def test_what_one_who_is_only_away_was_promised_acts(desk):
    begin = desk.world.tick
    desk.send((1, begin + 2, Attract(x=5.0, y=5.0, strength=1.0)))
    desk.players.depart("ana", SESSION, begin)
    acted = [one.sequence for _ in range(3) for one in tick(desk)]
    assert acted == [1]
