"""Inputs that fly: two players and the owner do everything that inputs can do, for any scene."""

from __future__ import annotations

import random

import kuglice as kg
from kuglice.inputs import Input

PLAYERS = (1, 2)


class Pilot:
    """Draws the inputs of one run from a seed. Some name balls that are gone."""

    def __init__(self, scene: kg.Scene, seed: int) -> None:
        self._random = random.Random(seed)
        self._scene = scene
        self._balls = len(scene.balls)
        self._sequence = 0

    def inputs(self, tick: int) -> list[Input]:
        """The inputs of a tick, in an arrival order that means nothing."""
        drawn: list[Input] = []
        if tick == 1:
            drawn += [self._join(client) for client in PLAYERS]
        if tick == 30:
            drawn.append(kg.Leave(client=2, sequence=self._next()))
        if tick == 45:
            drawn.append(self._join(2))
        for client in (0, *PLAYERS):
            drawn += self._of_client(client)
        self._random.shuffle(drawn)
        return drawn

    def _of_client(self, client: int) -> list[Input]:
        chance = self._random.random
        drawn: list[Input] = []
        if chance() < 0.3 and client:
            drawn.append(kg.Thrust(client=client, sequence=self._next(), x=self._speed(), y=self._speed()))
        if chance() < 0.1:
            x, y = self._point()
            strength = self._random.choice([0.0, self._span() * 5.0])
            drawn.append(kg.Attract(client=client, sequence=self._next(), x=x, y=y, strength=strength))
        if chance() < 0.2:
            ball = None if client and chance() < 0.5 else self._some_ball()
            kick = {"vx": self._speed(), "vy": self._speed()}
            drawn.append(kg.Kick(client=client, sequence=self._next(), ball=ball, **kick))
        if chance() < 0.15:
            drawn.append(self._spawn(client))
        if chance() < 0.1:
            drawn.append(kg.Remove(client=client, sequence=self._next(), ball=self._some_ball()))
        return drawn

    def _join(self, client: int) -> Input:
        self._balls += 1
        x, y = self._point()
        radius = self._radius()
        return kg.Join(client=client, sequence=self._next(), x=x, y=y, radius=radius, mass=2.0 * radius)

    def _spawn(self, client: int) -> Input:
        self._balls += 1
        x, y = self._point()
        radius = self._radius()
        flight = {"vx": self._speed(), "vy": self._speed(), "radius": radius, "mass": 3.0 * radius}
        return kg.Spawn(client=client, sequence=self._next(), x=x, y=y, **flight)

    def _next(self) -> int:
        self._sequence += 1
        return self._sequence

    def _span(self) -> float:
        left, bottom, right, top = self._scene.box
        return min(right - left, top - bottom)

    def _radius(self) -> float:
        return float(self._scene.balls.radius.mean()) * self._random.uniform(0.5, 1.5)

    def _speed(self) -> float:
        return self._random.uniform(-0.5, 0.5) * self._span()

    def _point(self) -> tuple[float, float]:
        left, bottom, right, top = self._scene.box
        return self._random.uniform(left, right), self._random.uniform(bottom, top)

    def _some_ball(self) -> int:
        return self._random.randrange(self._balls + 2)


def flight(scene: kg.Scene, ticks: int, seed: int = 1) -> list[list[Input]]:
    """The inputs of that many ticks."""
    pilot = Pilot(scene, seed)
    return [pilot.inputs(tick) for tick in range(ticks)]


def trail(world: kg.World, script: list[list[Input]]) -> list[int]:
    """Fly the script; the state hash after each tick."""
    hashes = []
    for inputs in script:
        world.step(inputs)
        hashes.append(world.state_hash)
    return hashes
