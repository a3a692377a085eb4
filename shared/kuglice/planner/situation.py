"""What the planner looks at in a scene: few numbers, each an estimate that its docstring explains."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kuglice.planner.demand import LONGEST
from kuglice.planner.resting import carried, settles
from kuglice.scene import Scene
from kuglice.scene.forces import Force
from kuglice.travel import longest_travel

__all__ = ["Situation", "situation"]

Floats = NDArray[np.float64]

CELL = 8.0
"""Side of the cells in which balls are counted, in mean diameters."""


@dataclass(frozen=True)
class Situation:
    """Lengths in the scene's unit, times in seconds; of balls that can move."""

    balls: int
    moving: int
    tick: float
    radius: float
    """Of the mean ball, as errors in radii see it: 1 / sqrt(mean 1 / r^2)."""
    speed: float
    """Root mean square, gained on the way down included."""
    who: str
    fastest: float
    """Speed of the ball that moves farthest in a tick, for its size; `who` says which."""
    share: float
    """What it moves, in radii: see kuglice.travel."""
    packing: float
    rate: float
    """Collisions per second and ball."""
    window: float
    """Until the mean ball has collided once, or LONGEST."""
    pressed: bool
    """Whether balls weigh on each other: a force drives them together, into more than half a layer."""
    carried: bool
    """Whether a force that lasts drives balls against walls or pegs, be they many or one."""
    settles: bool
    """Whether balls come to rest, there or on each other, since they lose what they bounce with."""
    fall_rate: float
    """1 / seconds of a fall from the mean height: sqrt(g / 2 h); 0 without gravity."""
    open: bool
    """Whether balls can be added."""

    @property
    def hits(self) -> float:
        """Collisions of the mean ball in the window: at most 1."""
        return min(1.0, self.rate * self.window)


def situation(scene: Scene) -> Situation:
    """The numbers of a scene as it starts."""
    balls = scene.balls
    movable = np.isfinite(balls.mass)
    radius, position = balls.radius[movable], balls.position[movable]
    squared = (balls.velocity[movable] ** 2).sum(axis=1)
    fall = _fall(scene, position)
    moving = len(radius)
    typical = 1.0 / math.sqrt(float((1.0 / (radius * radius)).mean())) if moving else 1.0
    speed = math.sqrt(float(squared.mean()) + fall) if moving else 0.0
    diameter = 2.0 * float(balls.radius.mean()) if moving else 1.0
    density = _density(balls.position, scene.box, diameter)
    packing = min(0.9, density * math.pi * float((balls.radius**2).mean())) if moving else 0.0
    rate = _rate(density, diameter, packing, speed)
    travel = longest_travel(scene)
    return Situation(
        balls=len(balls),
        moving=moving,
        tick=1.0 / scene.tick_rate,
        radius=typical,
        speed=speed,
        who=travel.who,
        fastest=travel.speed,
        share=travel.share,
        packing=packing,
        rate=rate,
        window=min(LONGEST, 1.0 / rate) if rate > 0.0 else LONGEST,
        pressed=_pressed(scene, radius),
        carried=carried(scene),
        settles=settles(scene),
        fall_rate=_fall_rate(scene, fall),
        open=scene.limits.spawn is not None or scene.players is not None,
    )


def _density(position: Floats, box: tuple[float, float, float, float], diameter: float) -> float:
    """Balls per area around the mean ball, itself left out: pairs are what collides, not the emptiness elsewhere."""
    if len(position) < 2:
        return 0.0
    left, bottom, right, top = box
    columns = max(1, round((right - left) / (CELL * diameter)))
    rows = max(1, round((top - bottom) / (CELL * diameter)))
    column = np.clip((position[:, 0] - left) / (right - left) * columns, 0, columns - 1).astype(np.int64)
    row = np.clip((position[:, 1] - bottom) / (top - bottom) * rows, 0, rows - 1).astype(np.int64)
    # Cells without a ball do not count, and there may be very many of them.
    _, counts = np.unique(row * columns + column, return_counts=True)
    area = (right - left) * (top - bottom) / (columns * rows)
    return float((counts * (counts - 1)).sum()) / (len(position) * area)


def _rate(density: float, diameter: float, packing: float, speed: float) -> float:
    """Enskog: 2 sqrt(pi) n sigma g sqrt(kT / m), with Henderson's g at contact, kT / m = v^2 / 2."""
    at_contact = (1.0 - 7.0 * packing / 16.0) / (1.0 - packing) ** 2
    return 2.0 * math.sqrt(math.pi) * density * diameter * at_contact * speed / math.sqrt(2.0)


def _fall(scene: Scene, position: Floats) -> float:
    """Speed squared that the mean ball gains by falling: as much as it has in potential energy, as in a column."""
    gained = 0.0
    for force in scene.forces:
        if force.kind != "gravity" or not len(position):
            continue
        for axis, pull in ((0, force.x), (1, force.y)):
            low, high = scene.box[axis], scene.box[axis + 2]
            heights = position[:, axis] - low if pull < 0 else high - position[:, axis]
            gained += abs(pull) * float(heights.mean())
    return gained


def _fall_rate(scene: Scene, fall: float) -> float:
    """From g h = `fall`: sqrt(g / 2 h) = g / sqrt(2 g h)."""
    pull = sum(math.hypot(force.x, force.y) for force in scene.forces if force.kind == "gravity")
    return pull / math.sqrt(2.0 * fall) if fall > 0.0 else 0.0


def _pressed(scene: Scene, radius: Floats) -> bool:
    return scene.walls and len(radius) > 2 and any(_presses(scene, force, radius) for force in scene.forces)


def _presses(scene: Scene, force: Force, radius: Floats) -> bool:
    left, bottom, right, top = scene.box
    match force.kind:
        case "gravity":
            floor = right - left if abs(force.y) >= abs(force.x) else top - bottom
            return bool(force.x or force.y) and float(2.0 * radius.sum()) > 0.5 * floor
        case "spring":
            return force.stiffness > 0
        case "attractor":
            # An elastic swarm keeps apart by its own heat.
            return force.strength > 0 and scene.restitution < 1.0
        case _:
            return False
