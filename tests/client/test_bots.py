"""Bots only ever do what the scene allows, and what they do has an effect."""

from __future__ import annotations

import numpy as np
import pytest

from kuglice import World, scenes
from kuglice.inputs import check, join
from kuglice_client.bots import BOTS, Sight


def played(bot: str, scene, seconds: float) -> tuple[World, int]:
    """A world in which client 1 is the bot and client 2 does nothing."""
    world = World(scene)
    for client in (1, 2):
        world.step([join(scene, world, client)])
    acted = 0
    for tick in range(round(seconds * scene.tick_rate)):
        inputs = []
        if tick % 4 == 0:
            given = BOTS[bot](Sight(world, dict(world.players)[1]))
            if given is not None:
                given = given.model_copy(update={"client": 1, "sequence": tick + 1})
                check(given, scene, world)
                inputs.append(given)
                acted += 1
        world.step(inputs)
    return world, acted


@pytest.mark.parametrize("bot", BOTS)
def test_every_bot_acts_within_the_limits_of_the_arena(bot):
    world, acted = played(bot, scenes.arena(players=2, balls=60), 10.0)
    assert acted > 50
    assert world.inputs_ignored == 0


@pytest.mark.parametrize("bot", ["chaser", "drifter", "orbiter"])
def test_those_that_steer_get_about(bot):
    scene = scenes.arena(players=2, balls=10)
    start = scene.players.spawn_points[0]
    world, _ = played(bot, scene, 3.0)
    ball = dict(world.players)[1]
    here = world.position[int(np.flatnonzero(world.id == ball)[0])]
    assert np.hypot(*(here - start)) > 5.0


def test_the_chaser_gets_its_prey():
    scene = scenes.arena(players=2, balls=10)
    world = World(scene)
    for client in (1, 2):
        world.step([join(scene, world, client)])
    nearest = np.inf
    for tick in range(600):
        balls = dict(world.players)
        given = BOTS["chaser"](Sight(world, balls[1]))
        world.step([given.model_copy(update={"client": 1, "sequence": tick})] if given is not None else [])
        rows = [int(np.flatnonzero(world.id == ball)[0]) for ball in balls.values()]
        nearest = min(nearest, float(np.hypot(*(world.position[rows[0]] - world.position[rows[1]]))))
    assert nearest < 2.6, "they touch at 2.4"


@pytest.mark.parametrize("bot", BOTS)
def test_without_a_ball_or_a_permission_a_bot_does_nothing_wrong(bot):
    scene = scenes.gas(n=20)
    world = World(scene)
    given = BOTS[bot](Sight(world, None))
    assert given is None
