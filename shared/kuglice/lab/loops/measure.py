"""The same gas run by each loop under each pattern of frames."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from kuglice.lab.jobs import Effort, Job
from kuglice.lab.loops.patterns import PATTERNS, QUARTER
from kuglice.lab.methods import Method
from kuglice.lab.rows import Row, Rows
from kuglice.lab.work_precision.errors import position_error
from kuglice.loop import Fixed, Interpolated, Loop, Variable
from kuglice.scene import Balls, Scene
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["LOOPS", "SHOWN", "jobs"]

Floats = NDArray[np.float64]

LOOPS: dict[str, tuple[type[Loop], str]] = {
    "variable": (Variable, "overlap"),
    "variable, event contacts": (Variable, "event"),
    "fixed": (Fixed, "overlap"),
    "interpolated": (Interpolated, "overlap"),
}
SECONDS = 3
SHOWN = 30
"""Frames of which single steps are kept."""


class Clock:
    """Says what it is told."""

    def __init__(self) -> None:
        self.now = 0

    def __call__(self) -> int:
        return self.now


def jobs(effort: Effort, left_out: list[str]) -> list[Job]:
    """Spread of states, and steps on the screen, per loop."""
    seeds = effort.seeds[:1] if effort.quick else effort.seeds
    return [
        *(Job(f"states of the {name} loop", partial(_spread, name, seeds)) for name in LOOPS),
        *(
            Job(f"steps of the {name} loop", partial(_steps, name))
            for name in ("variable", "fixed", "interpolated")
        ),
    ]


def _frames(name: str, scene: Scene, ends: list[int]) -> Iterator[tuple[int, Loop, Floats]]:
    """(end of the frame, loop, what is drawn) for every frame."""
    kind, contacts = LOOPS[name]
    clock = Clock()
    loop = kind(World(scene, Method("verlet", contacts).model()), clock=clock)
    for end in ends:
        clock.now = end
        loop.frame()
        drawn = loop.position if isinstance(loop, Interpolated) else loop.world.position
        yield end, loop, drawn


def _spread(name: str, seeds: tuple[int, ...]) -> Rows:
    """Largest distance between two patterns' states at equal times, root mean square over balls, in radii."""
    spread = np.zeros((len(seeds), 4 * SECONDS))
    for row, seed in enumerate(seeds):
        scene = gas(n=100, seed=seed)
        states = []
        for pattern in PATTERNS.values():
            frames = _frames(name, scene, pattern(4 * SECONDS))
            states.append([loop.world.position for end, loop, _ in frames if end % QUARTER == 0])
        for one, other in combinations(states, 2):
            apart = [position_error(a, b, scene.balls.radius) for a, b in zip(one, other, strict=True)]
            spread[row] = np.maximum(spread[row], apart)
    mean = np.sqrt((spread**2).mean(axis=0))
    return [
        {
            "kind": "spread",
            "loop": name,
            "x": 0.25 * (i + 1),
            "value": float(each),
            "seeds": " ".join(map(str, seeds)),
        }
        for i, each in enumerate(mean)
    ]


def _steps(name: str) -> Rows:
    """Steps of a ball in free flight on the screen, relative to what they should be."""
    scene = Scene(box=(0, 0, 100, 10), balls=Balls(position=[(1, 5)], velocity=[(10, 0)], radius=0.5))
    rows: list[Row] = []
    for pattern, ends_of in PATTERNS.items():
        ends = ends_of(4)
        drawn = np.array([position[0, 0] for _, _, position in _frames(name, scene, ends)])
        right = 10.0 * np.diff(ends) / 1e9
        steps = np.diff(drawn) / right
        # The first tick of a loop has no state before it to mix with.
        steps = steps[len(steps) // 8 :]
        jitter = float(np.sqrt(((steps - 1.0) ** 2).mean()))
        rows.append({"kind": "jitter", "loop": name, "pattern": pattern, "value": jitter})
        if pattern == "144 fps":
            rows += [
                {"kind": "step", "loop": name, "x": i, "value": float(step)}
                for i, step in enumerate(steps[:SHOWN])
            ]
    return rows
