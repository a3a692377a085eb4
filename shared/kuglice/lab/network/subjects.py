"""What is played over a bad network, and by whom."""

from __future__ import annotations

from dataclasses import dataclass

from kuglice import scenes
from kuglice.scene import InputLimits, PlayerRules, Scene, ThrustForce

__all__ = ["SUBJECTS", "Subject"]

TICK_RATE = 60.0
LANES = 4


@dataclass(frozen=True)
class Subject:
    """A scene, the bots that act in it, and how many clients only look on (each with a ball that does nothing)."""

    name: str
    scene: Scene
    bots: tuple[str, ...]
    onlookers: int = 0

    @property
    def clients(self) -> int:
        """All of them."""
        return len(self.bots) + self.onlookers


def _rain(n: int, radius: float) -> Scene:
    """Rain with room for players, at the tick rate of everything else here."""
    rain = scenes.rain(n=n, radius=radius)
    left, bottom, right, _ = rain.box
    points = tuple((left + (right - left) * (lane + 0.5) / LANES, bottom + 3.0) for lane in range(LANES))
    return rain.model_copy(
        update={
            "tick_rate": TICK_RATE,
            "forces": (*rain.forces, ThrustForce()),
            "limits": InputLimits(thrust=250.0, max_balls=n + LANES),
            "players": PlayerRules(radius=1.0, mass=8.0, spawn_points=points, max_players=LANES),
        }
    )


def _subjects() -> tuple[Subject, ...]:
    arena = scenes.arena(players=4, balls=20)
    return (
        Subject("arena", arena, ("chaser", "orbiter", "herder", "drifter")),
        Subject("arena, one acts", arena, ("orbiter",), onlookers=1),
        Subject("rain 1,000", _rain(1_000, 0.15), ("orbiter",), onlookers=1),
        Subject("rain 10,000", _rain(10_000, 0.08), ("orbiter",), onlookers=1),
    )


SUBJECTS = {subject.name: subject for subject in _subjects()}
