"""A bot is asked 15 times per second of the world, and says only what is new."""

from __future__ import annotations

import pytest

from kuglice.inputs import Thrust
from kuglice_client import autopilot
from kuglice_client.autopilot import Autopilot
from kuglice_client.bots import BOTS, Sight


@pytest.fixture
def bot(monkeypatch):
    """One that says what `says` holds, and when it was asked."""

    class Bot:
        says: Thrust | None = Thrust(x=1, y=0)
        asked: int = 0

        def __call__(self, sight: Sight) -> Thrust | None:
            self.asked += 1
            return self.says

    one = Bot()
    monkeypatch.setitem(autopilot.BOTS, "stubborn", one)
    return one


def test_it_is_asked_every_fifteenth_of_a_second_whatever_ticks_are_left_out(bot, authority):
    pilot = Autopilot("stubborn", rate=60.0)
    sight = Sight(authority.world, None)
    for tick in (0, 1, 3, 4, 7, 8, 20, 23, 24):
        pilot.wants(sight, tick)
    assert bot.asked == len((0, 4, 8, 20, 24))


def test_what_it_says_again_is_not_said_again(bot, authority):
    pilot = Autopilot("stubborn", rate=15.0)
    sight = Sight(authority.world, None)
    assert pilot.wants(sight, 0) == Thrust(x=1, y=0)
    assert pilot.wants(sight, 1) is None
    bot.says = None
    assert pilot.wants(sight, 2) is None
    bot.says = Thrust(x=0, y=1)
    assert pilot.wants(sight, 3) == Thrust(x=0, y=1)
    bot.says = Thrust(x=1, y=0)
    assert pilot.wants(sight, 4) == Thrust(x=1, y=0)


@pytest.mark.parametrize("name", [name for name in BOTS if name != "stubborn"])
def test_every_bot_can_be_at_the_controls(name, authority):
    own = dict(authority.world.players)[1]
    pilot = Autopilot(name, rate=60.0)
    said = []
    for _ in range(60):
        said.append(pilot.wants(Sight(authority.world, own), authority.world.tick))
        authority.step()
    assert any(given is not None for given in said)
